// What `vibrotrough design` proposed: its machines, and what it says of them, beside the answer of the page.

const designModels = { "the point mass": "by_mass", "the rolling-layer law": "by_layer", "the atlas": "by_atlas" };

/// The machines of the designs, at most two: the proposals of two files, or the two best of one.
function proposals() {
  return page.designs.flatMap((design) => design.machines.slice(0, page.designs.length > 1 ? 1 : 2).map((one, i) => ({ ...one, design, second: i > 0 })));
}

/// Takes the designs that the program put into the page. @param begin  whether the page begins with their machines
function readDesigns(begin) {
  page.designs = JSON.parse(document.getElementById("designs").textContent) || [];
  if (page.designs.length === 0) return;
  document.body.dataset.design = "";
  if (!begin) return;
  page.machines = proposals().map(({ settings: proposed }) => ({ ...page.machines[0], ...inRange(proposed) }));
  page.curveQuantity = "flow";
}

/// Settings that the page accepts; the others keep what they have.
function inRange(proposed) {
  return Object.fromEntries(Object.entries(proposed).filter(([name, value]) => value >= settingNamed[name].low && value <= settingNamed[name].high));
}

function takeProposal({ settings: proposed }) {
  Object.assign(machine(), inRange(proposed));
  settings.forEach(({ name }) => clearWrong(name));
  clearWrong("amplitude_mm");
  fillFields();
  changed();
}

/// A probability; nobody knows one better than to a tenth of a percent.
function percent(share) {
  if (!Number.isFinite(share)) return say("not_known");
  if (share < 0.001) return `< ${showNumber(0.1)} %`;
  return share > 0.999 ? `> ${showNumber(99.9)} %` : `${showNumber(100 * share)} %`;
}

function rowsOfProposal(one) {
  const models = one.models.length > 0 ? one.models : [{ model: "\u2013", probability: one.probability }];
  const range = (low, high) => (Number.isFinite(low) && Number.isFinite(high) ? showRange(low, high, "t/h") : "\u2013");
  return models.map((model, i) => make("tr", {}, make("th", { scope: "row" }, ...(i > 0 ? [] : [one.second ? say("design_next", one.design.name) : one.design.name, make("br"),
    make("button", { type: "button", click: () => takeProposal(one) }, say("use_case"))])),
    ...["stroke_mm", "rpm", "depth_mm"].map((name) => make("td", {}, i > 0 ? "" : fieldNumber(one.settings[name]))),
    make("td", {}, (designModels[model.model] ? say(designModels[model.model]) : model.model) + (model.is_beside ? ` (${say("design_beside")})` : "")), make("td", {}, showNumber(model.flow)),
    make("td", {}, range(model.flow_low, model.flow_high)), make("td", {}, percent(model.probability))));
}

function showDesigns() {
  document.getElementById("design-section").hidden = page.designs.length === 0;
  if (page.designs.length === 0) return;
  put("design-asked", page.designs.map((one) => `${page.designs.length > 1 ? `${one.name}: ` : ""}${say("design_asked", showNumber(one.wanted_t_per_h), percent(one.confidence))}`
    + `${one.untested ? ` ${say("design_untested")}` : ""}${one.assumed.length > 0 ? ` ${say("design_assumed", one.assumed.map((name) => `${axisTitle(name)}: ${fieldNumber(one.machines[0].settings[name])}`).join(", "))}` : ""}`).join(" "));
  const head = ["", axisTitle("stroke_mm"), axisTitle("rpm"), axisTitle("depth_mm"), say("model"), `${say("flow")} [t/h]`, "95 %", say("design_probability")];
  document.getElementById("design-table").replaceChildren(make("thead", {}, make("tr", {}, ...head.map((text) => make("th", { scope: "col" }, text)))),
    make("tbody", {}, ...proposals().flatMap(rowsOfProposal)));
  showDesignNow();
}

/// What the page says of the machines as they are set now, against what was asked.
function showDesignNow() {
  if (page.designs.length === 0) return;
  const wanted = page.designs[0].wanted_t_per_h;
  put("design-now", page.answers.map((answer, i) => {
    if (!answer || !Number.isFinite(answer.best_flow)) return "";
    const known = Number.isFinite(answer.best_flow_low), reach = !known ? "design_reach_unknown" : answer.best_flow_low >= wanted ? "design_reach_all"
      : answer.best_flow_high < wanted ? "design_reach_none" : "design_reach_part";
    const band = known ? `, 95 %: ${showRange(answer.best_flow_low, answer.best_flow_high, "t/h")}` : "";
    return say("design_now", say(i === 0 ? "machine_a" : "machine_b"), showNumber(answer.best_flow), say(modelWords[answer.model]), band, say(reach));
  }).filter(Boolean).join(" "));
}

/// The mass flows that were asked, as lines over the picture's width.
function wantedFlows() { return page.curveQuantity === "flow" ? [...new Set(page.designs.map((one) => one.wanted_t_per_h))] : []; }
