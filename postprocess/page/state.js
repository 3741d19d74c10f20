// What is set on the page: two machines at most, units, language and axes; and the same as a link.

/// Each setting: its unit, what is accepted (low to high), and the slider (from, to, step).
const settings = [
  { name: "stroke_mm", group: "machine", unit: "mm", low: 0.1, high: 100, from: 0.5, to: 20, step: 0.1, start: 9.7 },
  { name: "rpm", group: "machine", unit: "unit_rpm", low: 30, high: 12000, from: 200, to: 3600, step: 10, start: 960 },
  { name: "vibration_angle_deg", group: "machine", unit: "\u00b0", low: 1, high: 85, from: 10, to: 60, step: 0.5, start: 30 },
  { name: "inclination_deg", group: "machine", unit: "\u00b0", low: -30, high: 30, from: -10, to: 10, step: 0.1, start: 0 },
  { name: "friction", group: "material", unit: "unit_1", low: 0, high: 5, from: 0.05, to: 1, step: 0.01, start: 0.3 },
  { name: "friction_band", group: "material", unit: "unit_1", low: 0, high: 1, from: 0, to: 0.15, step: 0.005, start: 0.03 },
  { name: "rolling_friction", group: "material", unit: "unit_1", low: 0, high: 5, from: 0, to: 0.3, step: 0.01, start: 0 },
  { name: "grain_mm", group: "material", unit: "mm", low: 0.01, high: 200, from: 0.5, to: 20, step: 0.1, start: 3 },
  { name: "bulk_density", group: "material", unit: "kg/m\u00b3", low: 1, high: 15000, from: 100, to: 3000, step: 10, start: 600 },
  { name: "depth_mm", group: "layer", unit: "mm", low: 0.1, high: 2000, from: 2, to: 150, step: 1, start: 12 },
  { name: "width_mm", group: "layer", unit: "mm", low: 1, high: 10000, from: 50, to: 2000, step: 10, start: 300 },
];
const settingNamed = Object.fromEntries(settings.map((one) => [one.name, one]));
/// What can be an axis of a picture.
const axisNames = settings.map((one) => one.name).filter((name) => !["friction_band", "rolling_friction", "grain_mm"].includes(name));
const mapAxisNames = ["stroke_mm", "rpm", "vibration_angle_deg", "inclination_deg", "friction"];

const page = {
  language: "en", speedUnit: "m/s", machines: [Object.fromEntries(settings.map((one) => [one.name, one.start]))], active: 0,
  curveAxis: "stroke_mm", curveQuantity: "speed", mapX: "stroke_mm", mapY: "vibration_angle_deg", mapModel: "layer", motionModel: "layer",
  measured: null, cases: [], designs: [], wrong: new Set(), theory: null, answers: [],
};

/// Other choices that a link holds, and what they may be.
const choices = {
  language: { key: "lang", values: ["en", "de"] }, speedUnit: { key: "unit", values: ["m/s", "m/min"] }, curveAxis: { key: "x", values: axisNames },
  curveQuantity: { key: "y", values: ["speed", "flow"] }, mapX: { key: "map_x", values: mapAxisNames }, mapY: { key: "map_y", values: mapAxisNames },
  mapModel: { key: "map", values: ["layer", "mass"] }, motionModel: { key: "motion", values: ["layer", "mass"] },
};

function machine() { return page.machines[page.active]; }

/// The part of a link behind '#'.
function linkPart() {
  const parts = new URLSearchParams();
  page.machines.forEach((one, i) => settings.forEach(({ name }) => parts.set(i === 0 ? name : `b.${name}`, Number(one[name].toPrecision(12)))));
  for (const [choice, { key }] of Object.entries(choices)) parts.set(key, page[choice]);
  return parts.toString();
}

/// Takes what is understood of a link; numbers out of range stay as they are.
function readLink(text) {
  const parts = new URLSearchParams(text.replace(/^#/, ""));
  const take = (machineSettings, prefix) => settings.forEach(({ name, low, high }) => {
    const value = parts.has(prefix + name) ? parseNumber(parts.get(prefix + name)) : NaN;
    if (value >= low && value <= high) machineSettings[name] = value;
  });
  take(page.machines[0], "");
  if ([...parts.keys()].some((key) => key.startsWith("b."))) {
    page.machines[1] = { ...page.machines[0] };
    take(page.machines[1], "b.");
  }
  for (const [choice, { key, values }] of Object.entries(choices)) if (values.includes(parts.get(key))) page[choice] = parts.get(key);
}

let linkTimer = 0;
/// Browsers allow few changes of the address in a second.
function keepLink() {
  clearTimeout(linkTimer);
  linkTimer = setTimeout(() => { try { history.replaceState(null, "", `#${linkPart()}`); } catch (error) { /* not with every address */ } }, 400);
}

function speedFactor() { return page.speedUnit === "m/min" ? 60 : 1; }
function showSpeed(metresPerSecond) { return showNumber(metresPerSecond * speedFactor()); }
function unitOf(setting) { return setting.unit.startsWith("unit_") ? say(setting.unit) : setting.unit; }
function axisTitle(name) { const unit = unitOf(settingNamed[name]); return unit ? `${say(name)} [${unit}]` : say(name); }

/// The range of an axis: that of the slider, widened to hold the machines.
function axisRange(name) {
  const { from, to } = settingNamed[name];
  const values = page.machines.map((one) => one[name]);
  return [Math.min(from, ...values), Math.max(to, ...values)];
}
