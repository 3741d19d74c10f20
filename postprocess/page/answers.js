// The answer: what is always in sight, and what is said about it.

function put(id, text) { document.getElementById(id).textContent = text; }

function withUnit(value, unit) { return Number.isFinite(value) ? `${showNumber(value)} ${unit}` : say("none"); }

function speedText(metresPerSecond) { return withUnit(metresPerSecond * speedFactor(), page.speedUnit); }

const modelWords = ["by_layer", "by_mass", "by_atlas"], ofAtlas = 2;

/// The answer of a machine with its words. @throws Error where the theory has none
function answerOf(one) {
  const answer = page.theory.answer(one);
  return { ...answer, words: page.theory.words(one) };
}

function showAnswer(answer) {
  put("speed", speedText(answer.best_speed));
  put("speed-band", showRange(answer.best_low * speedFactor(), answer.best_high * speedFactor(), page.speedUnit));
  put("flow", withUnit(answer.best_flow, "t/h"));
  put("flow-band", showRange(answer.best_flow_low, answer.best_flow_high, "t/h"));
  put("throw-number", showNumber(answer.throw_number));
  put("machine-number", `${showNumber(answer.machine_number)} g`);
  put("atlas-speed", speedText(answer.atlas_speed));
  put("atlas-band", Number.isFinite(answer.atlas_low) ? showRange(answer.atlas_low * speedFactor(), answer.atlas_high * speedFactor(), page.speedUnit) : "");
  put("layer-speed", speedText(answer.layer_speed));
  put("mass-speed", speedText(answer.mass_speed));
  put("efficiency", showNumber(answer.best_efficiency));
  put("model", say(modelWords[answer.model]));
  put("depth-in-grains", showNumber(answer.depth_in_grains));
  const { landing } = answer.words, motion = answer.model === 1 ? answer.words.mass : answer.words.layer;
  put("landing-speed", landing && landing.impact_speed > 0 ? speedText(landing.impact_speed) : say("none"));
  put("power", landing ? withUnit(landing.power_per_area, "W/m\u00b2") : say("not_known"));
  put("sentence", motionSentence(motion));
  put("mode", motion.mode || say("none"));
  showTrust(answer);
  speakLater();
}

let speakTimer = 0;
/// For screen readers: what the answer came to when the changes are over.
function speakLater() {
  clearTimeout(speakTimer);
  const text = (id) => document.getElementById(id).textContent;
  speakTimer = setTimeout(() => put("spoken", `${say("speed")} ${text("speed")}, ${say("flow")} ${text("flow")}, ${text("trust-word")}. ${text("reason")}`), 700);
}

/// Grey, amber or red, with the reason in words.
function showTrust(answer) {
  const reasons = [...(answer.words.untested ? [answer.words.untested] : []), ...answer.words.unusual].map(sayTheory);
  if (reasons.length === 0) reasons.push(say(answer.model === ofAtlas ? "atlas_note" : "tested_note"));
  reasons.push(...answer.words.outside_atlas.map(sayTheory));
  const level = page.wrong.size > 0 ? "wrong" : answer.words.unusual.length > 0 ? 2 : answer.trust;
  document.getElementById("summary").dataset.trust = level;
  put("trust-word", say(`trust_${level}`));
  if (level === "wrong") reasons.unshift(say("wrong_note"));
  put("reason", reasons.join(" "));
  document.getElementById("reason").dataset.trust = level;
}

function showNoAnswer(message) {
  for (const id of ["speed", "speed-band", "flow", "flow-band", "throw-number", "machine-number", "atlas-speed", "atlas-band", "layer-speed", "mass-speed", "efficiency", "model",
    "depth-in-grains", "landing-speed", "power", "sentence", "mode"]) put(id, "\u2013");
  document.getElementById("summary").dataset.trust = 2;
  put("trust-word", say("trust_2"));
  put("reason", say("no_answer", message));
  document.getElementById("reason").dataset.trust = 2;
}

/// In per cent of the first, to a tenth: rounding noise is not a difference.
function differenceText(a, b) {
  if (!a || !Number.isFinite(b)) return "\u2013";
  const tenths = Math.round(1000 * (b / a - 1)) / 10;
  return `${tenths > 0 ? "+" : ""}${showNumber(tenths)} %`;
}

/// Both machines side by side: what differs of the inputs, and the answers.
function showComparison() {
  const both = page.answers.length === 2 && page.answers.every((one) => one);
  document.getElementById("comparison").hidden = !both;
  if (!both) return;
  const rows = settings.filter(({ name }) => page.machines[0][name] !== page.machines[1][name]).map((setting) =>
    [axisTitle(setting.name), ...page.machines.map((one) => one[setting.name])]);
  const factor = speedFactor(), answered = [
    [`${say("speed")} [${page.speedUnit}]`, (a) => a.best_speed * factor], [`${say("flow")} [t/h]`, (a) => a.best_flow],
    [say("throw_number"), (a) => a.throw_number], [`${say("machine_number")} [g]`, (a) => a.machine_number],
    [`${say("landing_speed")} [${page.speedUnit}]`, (a) => (a.words.landing ? a.words.landing.impact_speed * factor : NaN)],
    [`${say("power")} [W/m\u00b2]`, (a) => (a.words.landing ? a.words.landing.power_per_area : NaN)]];
  for (const [title, value] of answered) rows.push([title, ...page.answers.map(value)]);
  const head = make("tr", {}, make("td"), ...["A", "B", say("difference")].map((text) => make("th", { scope: "col" }, text)));
  const lines = rows.map(([title, a, b]) => make("tr", {}, make("th", { scope: "row" }, title), make("td", {}, showNumber(a)), make("td", {}, showNumber(b)),
    make("td", {}, differenceText(a, b))));
  document.getElementById("comparison-table").replaceChildren(make("thead", {}, head), make("tbody", {}, ...lines));
}
