// The trough and the material through a cycle, in slow motion, with the forces of the trough on it.

const motionFrames = 361;
const motion = { key: "", frames: null, cycles: 1, playing: false, degrees: 0, last: 0 };

function takeMotion() {
  const one = machine(), key = JSON.stringify([page.motionModel, one.stroke_mm, one.rpm, one.vibration_angle_deg, one.inclination_deg, one.friction]);
  if (motion.key === key) return;
  motion.key = key;
  motion.frames = page.theory.frames(one, page.motionModel === "layer", motionFrames);
  const frames = motion.frames;
  motion.cycles = frames ? Math.max(1, Math.round((frames[motionFrames - 1].time - frames[0].time) * one.rpm / 60)) : 1;
  document.getElementById("phase").max = 360 * motion.cycles;
  if (frames) {
    // While the material rides on the trough its normal force is at most 1 + throw number; the peaks of landings are higher.
    const most = weight() * (1 + page.theory.answer(one).throw_number) * 1.15, largest = Math.max(...frames.map((f) => f.normal_force));
    motion.largest = { normal: Math.min(largest, most), shear: Math.min(Math.max(...frames.map((f) => Math.abs(f.tangential_force))), most),
      gap: Math.max(...frames.map((f) => f.gap)), cut: largest > most };
  }
}

/// The frame at an angle from the start of the period, and the travel up to it over all periods.
function frameAt(angle) {
  const whole = 360 * motion.cycles, within = ((angle % whole) + whole) % whole;
  return motion.frames[Math.round(within / whole * (motionFrames - 1))];
}

function drawMotion() {
  takeMotion();
  const { context, width, height, colour } = sharpCanvas("motion", 0.72, 460);
  put("motion-text", motion.frames ? motionText() : say("no_motion"));
  if (!motion.frames) return;
  const frame = frameAt(motion.degrees), scene = height * 0.55;
  drawTrough(context, frame, width, scene, colour);
  drawForces(context, width, scene, height, colour);
}

function weight() { return 9.81 * Math.cos(machine().inclination_deg / degrees); }

function motionText() {
  const frame = frameAt(motion.degrees), place = `${say("phase_angle")} ${Math.round(motion.degrees % (360 * motion.cycles))}\u00b0`;
  const force = frame.gap > 0 && frame.normal_force === 0 ? say("flight") : `${say("normal_force")} ${showNumber(frame.normal_force / weight())}, ${say("friction_force")} ${showNumber(frame.tangential_force / weight())} ${say("in_weights")}`;
  return `${place}: ${force}. ${motion.largest.cut ? say("cut_off") : ""}`;
}

/// The trough is drawn with its inclination; displacements are as large as fit.
function drawTrough(context, frame, width, scene, colour) {
  const stroke = machine().stroke_mm / 1000, scale = Math.min(scene * 0.16 / stroke, scene * 0.42 / Math.max(motion.largest.gap, stroke * 0.4));
  const alpha = machine().inclination_deg / degrees;
  context.save();
  context.translate(width / 2, scene * 0.78);
  context.rotate(-alpha);
  const x = frame.trough_x * scale, y = -frame.trough_y * scale, long = width * 0.4;
  context.strokeStyle = colour("line");
  context.setLineDash([4, 4]);
  context.beginPath();
  context.moveTo(-long, 0);
  context.lineTo(long, 0);
  context.stroke();
  context.setLineDash([]);
  context.fillStyle = colour("trough");
  context.fillRect(-long + x, y, 2 * long, 8);
  for (let k = -6; k <= 6; ++k) context.fillRect(x + k * long / 6.5 - 1.5, y + 8, 3, 7);
  const place = placeOnTrough(frame, scale, long), size = Math.min(34, scene * 0.16), bottom = y - Math.max(frame.gap, 0) * scale;
  const cx = x + place;
  context.fillStyle = colour("mass");
  context.beginPath();
  context.roundRect(cx - size * 0.8, bottom - size, 1.6 * size, size, 5);
  context.fill();
  const most = motion.largest.normal, force = scene * 0.3 / Math.max(most, weight());
  drawArrow(context, cx, bottom, 0, -Math.min(frame.normal_force, most) * force, colour("normal"));
  drawArrow(context, cx, bottom - 3, Math.max(-most, Math.min(frame.tangential_force, most)) * force, 0, colour("shear"));
  context.restore();
}

/// The material moves on from period to period and comes back at the left.
function placeOnTrough(frame, scale, long) {
  const whole = 360 * motion.cycles, periods = Math.floor(motion.degrees / whole), last = motion.frames[motionFrames - 1].travel;
  const way = (frame.travel + periods * last) * scale, room = 1.6 * long;
  return ((way % room) + room) % room - room / 2;
}

function drawArrow(context, x, y, dx, dy, colour) {
  const size = Math.hypot(dx, dy);
  if (size < 3) return;
  const ux = dx / size, uy = dy / size, head = Math.min(9, size * 0.6);
  context.strokeStyle = context.fillStyle = colour;
  context.lineWidth = 3;
  context.beginPath();
  context.moveTo(x, y);
  context.lineTo(x + dx - ux * head * 0.7, y + dy - uy * head * 0.7);
  context.stroke();
  context.beginPath();
  context.moveTo(x + dx, y + dy);
  context.lineTo(x + dx - ux * head - uy * head * 0.6, y + dy - uy * head + ux * head * 0.6);
  context.lineTo(x + dx - ux * head + uy * head * 0.6, y + dy - uy * head - ux * head * 0.6);
  context.fill();
}

/// Normal force and friction over the period, in weights; the flight is shaded.
function drawForces(context, width, from, to, colour) {
  const left = 40, right = 10, above = from + 12, below = to - 34, frames = motion.frames, w = weight();
  const top = Math.max(1, motion.largest.normal / w) * 1.08, bottom = -Math.max(0.2, motion.largest.shear / w) * 1.15;
  const x = (i) => left + i / (motionFrames - 1) * (width - left - right), y = (force) => below - (Math.max(bottom, Math.min(force / w, top)) - bottom) / (top - bottom) * (below - above);
  context.fillStyle = colour("shade");
  frames.forEach((f, i) => { if (f.kind === 3) context.fillRect(x(i), above, x(1) - x(0) + 0.6, below - above); });
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "right";
  for (const value of ticks(bottom, top, 4)) {
    context.strokeStyle = colour("line");
    context.lineWidth = 1;
    context.beginPath();
    context.moveTo(left, y(value * w));
    context.lineTo(width - right, y(value * w));
    context.stroke();
    context.fillStyle = colour("quiet");
    context.fillText(fieldNumber(value), left - 5, y(value * w) + 4);
  }
  context.textAlign = "center";
  for (let angle = 0; angle <= 360 * motion.cycles; angle += 90 * motion.cycles) context.fillText(`${angle}\u00b0`, Math.min(width - 22, x(angle / (360 * motion.cycles) * (motionFrames - 1))), below + 16);
  for (const [name, tint] of [["normal_force", "normal"], ["tangential_force", "shear"]]) {
    context.strokeStyle = colour(tint);
    context.lineWidth = 2;
    context.beginPath();
    frames.forEach((f, i) => (i === 0 ? context.moveTo(x(i), y(f[name])) : context.lineTo(x(i), y(f[name]))));
    context.stroke();
  }
  const whole = 360 * motion.cycles, now = x((motion.degrees % whole) / whole * (motionFrames - 1));
  context.strokeStyle = colour("text");
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(now, above);
  context.lineTo(now, below);
  context.stroke();
}

function showMotionLegend() {
  const entries = [["normal", "normal_force"], ["shear", "friction_force"], ["shade", "flight"]];
  document.getElementById("motion-legend").replaceChildren(...entries.map(([key, word]) => {
    const mark = make("span", { class: "key fill", "aria-hidden": "true" });
    mark.style.background = `var(--${key})`;
    return make("li", {}, mark, `${say(word)}${key === "shade" ? "" : ` ${say("in_weights")}`}`);
  }));
  put("play", say(motion.playing ? "pause" : "play"));
}

function stepMotion(now) {
  const passed = Math.min(now - motion.last, 100) / 1000;
  motion.last = now;
  if (!motion.playing || !motion.frames) return false;
  const slowness = Number(document.getElementById("slowness").value);
  motion.degrees += 360 * machine().rpm / 60 / slowness * passed;
  document.getElementById("phase").value = motion.degrees % (360 * motion.cycles);
  return isSeen("motion");
}

function isSeen(id) {
  const box = document.getElementById(id).getBoundingClientRect();
  return box.bottom > 0 && box.top < window.innerHeight;
}

function setPlaying(playing) {
  motion.playing = playing;
  showMotionLegend();
  wake();
}
