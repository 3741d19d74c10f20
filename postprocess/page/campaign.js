// The cases of a campaign that the program put into the page, and the machine as a campaign file.

/// The names of settings in the table of cases.
const caseColumns = { stroke_mm: "stroke_mm", rpm: "turns_per_minute", vibration_angle_deg: "vibration_angle_deg", inclination_deg: "inclination_deg", depth_mm: "depth_mm", friction: "friction" };

function caseValue(one, name) { return one[caseColumns[name]]; }

/// Whether all inputs of a case but the one on the axis are those of the machine, to a hundredth.
function isLikeMachine(one) {
  return Object.keys(caseColumns).filter((name) => name !== page.curveAxis).every((name) => {
    const ours = machine()[name], theirs = caseValue(one, name);
    return Math.abs(ours - theirs) <= 0.01 * Math.max(Math.abs(ours), Math.abs(theirs), name === "inclination_deg" ? 1 : 0);
  });
}

function casePoints() {
  const isSpeed = page.curveQuantity === "speed", factor = isSpeed ? speedFactor() : 1;
  return page.cases.flatMap((one) => {
    const x = caseValue(one, page.curveAxis), y = isSpeed ? one.conveying_speed_m_per_s : one.mass_flow_t_per_h;
    if (!Number.isFinite(x) || !Number.isFinite(y)) return [];
    const bar = isSpeed ? one.conveying_speed_half_width_m_per_s : one.mass_flow_half_width_t_per_h;
    return [{ kind: isLikeMachine(one) ? "simulated" : "simulated other", x, y: y * factor, bar: (bar || 0) * factor,
      title: `${say("campaign_case")} ${one.label || one.case}: ${showNumber(y * factor)} ${isSpeed ? page.speedUnit : "t/h"}` }];
  });
}

function takeCase(one) {
  for (const name of Object.keys(caseColumns)) if (Number.isFinite(caseValue(one, name))) machine()[name] = caseValue(one, name);
  settings.forEach(({ name }) => clearWrong(name));
  clearWrong("amplitude_mm");
  fillFields();
  changed();
}

function showCases() {
  document.getElementById("campaign-section").hidden = page.cases.length === 0;
  if (page.cases.length === 0) return;
  put("campaign-title", say("campaign_title", page.campaignName));
  const head = [say("campaign_case"), "\u0393", ...Object.keys(caseColumns).map(axisTitle), `${say("speed")} [${page.speedUnit}]`, "t/h", ""];
  const pm = (value, bar) => (Number.isFinite(value) ? `${showNumber(value)} \u00b1 ${showNumber(bar, 2)}` : "\u2013");
  const rows = page.cases.slice(0, 200).map((one) => make("tr", {}, make("th", { scope: "row" }, one.label || one.case), make("td", {}, showNumber(one.throw_number)),
    ...Object.keys(caseColumns).map((name) => make("td", {}, showNumber(caseValue(one, name)))),
    make("td", {}, pm(one.conveying_speed_m_per_s * speedFactor(), one.conveying_speed_half_width_m_per_s * speedFactor())),
    make("td", {}, pm(one.mass_flow_t_per_h, one.mass_flow_half_width_t_per_h)), make("td", {}, make("button", { type: "button", click: () => takeCase(one) }, say("use_case")))));
  document.getElementById("campaign-table").replaceChildren(make("thead", {}, make("tr", {}, ...head.map((text) => make("th", { scope: "col" }, text)))), make("tbody", {}, ...rows));
}

function readCases() {
  const embedded = JSON.parse(document.getElementById("campaign").textContent);
  if (!embedded) return;
  page.campaignName = embedded.name;
  page.cases = embedded.cases;
}

/// Numbers in the campaign file: all digits, with a point.
function plain(value) { return String(Number(value.toPrecision(12))); }

/// A campaign of one case: this machine. The keys are those of `vibrotrough keys`.
function campaignFile(one) {
  const length = Math.max(12, 4) * one.grain_mm, width = 6 * one.grain_mm;
  const rolling = one.rolling_friction > 0 ? `rotation = "rolling"\nrolling_friction = ${plain(one.rolling_friction)}\n` : "";
  return `# From the page of Vibrotrough. What the page does not know is assumed and marked so: put in what you know.
#     vibrotrough check machine.toml
#     vibrotrough run machine.toml

[campaign]
name = "machine"

[trough]
stroke = "${plain(one.stroke_mm)} mm"
frequency = "${plain(one.rpm)} rpm"
vibration_angle = "${plain(one.vibration_angle_deg)} deg"
inclination = "${plain(one.inclination_deg)} deg"
width = "${plain(one.width_mm)} mm"
friction = ${plain(one.friction)}
restitution = 0.6026     # assumed: the middle of what was simulated

[grains]
diameter = "${plain(one.grain_mm)} mm"
diameter_spread = 0.1    # assumed: grains of one size pack like a crystal
bulk_density = "${plain(one.bulk_density)} kg/m3"
${rolling}poisson_ratio = 0.35     # assumed
friction = 0.5           # assumed: of grain on grain
restitution = 0.6026     # assumed: the middle of what was simulated

[layer]                  # a piece out of the middle of the trough, periodic along and across
length = "${plain(length)} mm"
width = "${plain(width)} mm"
height = "${plain(one.depth_mm)} mm"

[measure]
packings = 4
half_width = 0.05
max_cycles = 80
`;
}

/// Copies, and shows the text where the browser refuses or to be looked at.
async function copyText(text, message) {
  let done = message;
  try {
    await navigator.clipboard.writeText(text);
  } catch (error) {
    const field = document.getElementById("copied-text");
    document.getElementById("copied").hidden = false;
    field.value = text;
    field.focus();
    field.select();
    let copied = false;
    try { copied = document.execCommand("copy"); } catch (refused) { copied = false; }
    if (!copied) done = say("copy_failed");
  }
  document.getElementById("copied").hidden = false;
  document.getElementById("copied-text").value = text;
  showMessage(done);
}

function showMessage(text) {
  put("message", text);
  document.getElementById("message").hidden = text === "";
}
