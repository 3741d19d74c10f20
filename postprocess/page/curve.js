// Speed or mass flow over one input, with the machines, simulated cases and measured points.

const curvePoints = 121;

/// 0 to n - 1 so that every beginning of the list is spread evenly: a curve can be drawn while it is being computed.
function spreadOrder(n) {
  const order = [0, n - 1], seen = new Set(order);
  for (let step = n; step >= 1; step = Math.floor(step / 2)) {
    for (let i = 0; i < n; i += step) if (!seen.has(i)) { seen.add(i); order.push(i); }
    if (step === 1) break;
  }
  return order;
}
const curveOrder = spreadOrder(curvePoints);

/// Curves by what they depend on, so that they are not computed again while only the own point moves.
const curves = [null, null];

function curveKey(one) {
  return JSON.stringify([page.curveAxis, axisRange(page.curveAxis), { ...one, [page.curveAxis]: 0 }]);
}

/// Computes points until the time is over. @return whether there is nothing left to do
function growCurves(until) {
  let complete = true;
  page.machines.forEach((one, i) => {
    const key = curveKey(one);
    if (!curves[i] || curves[i].key !== key) curves[i] = { key, next: 0, points: new Array(curvePoints).fill(null) };
    const curve = curves[i], [from, to] = axisRange(page.curveAxis);
    while (curve.next < curvePoints && (performance.now() < until || curve.next < 9)) {
      const k = curveOrder[curve.next++], value = from + (to - from) * k / (curvePoints - 1);
      const answer = page.theory.answerAt(one, page.curveAxis, value);
      if (answer) curve.points[k] = { value, answer };
    }
    complete = complete && curve.next === curvePoints;
  });
  return complete;
}

/// Numbers for the ticks of an axis.
function ticks(low, high, count) {
  const rough = (high - low) / count, power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 2.5, 5, 10].map((one) => one * power).find((one) => one >= rough);
  const list = [];
  for (let value = Math.ceil(low / step - 1e-9) * step; value <= high + 1e-9 * step; value += step) list.push(Math.abs(value) < 1e-9 * step ? 0 : value);
  return list;
}

function svg(tag, attributes, ...content) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) element.setAttribute(name, value);
  element.append(...content);
  return element;
}

/// Names of what is drawn upwards: speed in the page's unit, or t/h.
function quantityOf() {
  const isSpeed = page.curveQuantity === "speed";
  return isSpeed ? { of: (name) => `${name}_speed`, low: "best_low", high: "best_high", factor: speedFactor(), title: `${say("speed")} [${page.speedUnit}]` }
    : { of: (name) => `${name}_flow`, low: "best_flow_low", high: "best_flow_high", factor: 1, title: `${say("flow")} [t/h]` };
}

function drawCurves() {
  const picture = document.getElementById("curve"), width = Math.max(280, picture.parentNode.clientWidth - 2 * 14), height = Math.min(420, Math.max(260, width * 0.5));
  const quantity = quantityOf(), [from, to] = axisRange(page.curveAxis), marks = pointsOnCurve();
  const values = curves.slice(0, page.machines.length).flatMap((curve) => (curve ? curve.points : [])).filter(Boolean)
    .flatMap(({ answer }) => [answer[quantity.of("rule")], answer[quantity.of("mass")], answer[quantity.of("layer")], answer[quantity.of("atlas")], answer[quantity.high]]).concat(marks.flatMap((one) => [one.y + one.bar, one.y - one.bar].map((y) => y / quantity.factor)))
    .filter(Number.isFinite).map((value) => value * quantity.factor).concat(wantedFlows());
  const top = Math.max(1e-6, ...values) * 1.05, bottom = Math.min(0, ...values) * 1.05;
  const left = 52, right = 12, above = 10, below = 42;
  const x = (value) => left + (value - from) / (to - from) * (width - left - right), y = (value) => above + (top - value) / (top - bottom) * (height - above - below);
  const parts = frameParts({ x, y, from, to, bottom, top, width, height, left, right, above, below, title: quantity.title });
  curves.slice(0, page.machines.length).forEach((curve, i) => { if (curve) parts.push(...curveParts(curve, i, quantity, x, y)); });
  for (const flow of wantedFlows()) parts.push(svg("line", { x1: left, x2: width - right, y1: y(flow), y2: y(flow), class: "asked" }),
    svg("text", { x: left + 4, y: y(flow) - 5, class: "tick" }, say("asked", showNumber(flow))));
  for (const one of marks) if (one.x >= from && one.x <= to) parts.push(markPart(one, x, y));
  page.answers.forEach((answer, i) => {
    if (!answer || !Number.isFinite(answer[quantity.of("best")])) return;
    const cx = x(page.machines[i][page.curveAxis]), cy = y(answer[quantity.of("best")] * quantity.factor);
    parts.push(svg("line", { x1: cx, x2: cx, y1: y(bottom), y2: cy, class: "drop" }), svg("circle", { cx, cy, r: 6, class: `own own-${i}` }));
    if (page.machines.length > 1) parts.push(svg("text", { x: cx + 9, y: cy - 7, class: "name" }, "AB"[i]));
  });
  picture.setAttribute("viewBox", `0 0 ${width} ${height}`);
  picture.replaceChildren(...parts);
}

function frameParts({ x, y, from, to, bottom, top, width, height, left, right, above, below, title }) {
  const parts = [];
  for (const value of ticks(from, to, Math.max(3, width / 110))) {
    parts.push(svg("line", { x1: x(value), x2: x(value), y1: above, y2: height - below, class: "grid" }),
      svg("text", { x: x(value), y: height - below + 16, class: "tick", "text-anchor": "middle" }, fieldNumber(value)));
  }
  for (const value of ticks(bottom, top, 5)) {
    parts.push(svg("line", { x1: left, x2: width - right, y1: y(value), y2: y(value), class: value === 0 ? "zero" : "grid" }),
      svg("text", { x: left - 6, y: y(value) + 4, class: "tick", "text-anchor": "end" }, fieldNumber(value)));
  }
  parts.push(svg("text", { x: (left + width - right) / 2, y: height - 6, class: "axis", "text-anchor": "middle" }, axisTitle(page.curveAxis)),
    svg("text", { x: 0, y: 0, class: "axis", "text-anchor": "middle", transform: `translate(13 ${(above + height - below) / 2}) rotate(-90)` }, title));
  return parts;
}

/// Band, maker's rule, point mass, law and atlas of one machine.
function curveParts(curve, i, quantity, x, y) {
  const points = curve.points.filter(Boolean);
  const at = (point, name) => point.answer[name] * quantity.factor;
  const path = (list, name) => runsOf(list, (point) => Number.isFinite(at(point, name)))
    .map((run) => `M${run.map((point) => `${x(point.value).toFixed(1)} ${y(at(point, name)).toFixed(1)}`).join("L")}`).join("");
  // Atlas and models have bands of their own: where one ends and the other begins, the answer changes its source.
  const band = (list) => runsOf(list, (point) => Number.isFinite(at(point, quantity.low))).map((run) => {
    const lower = run.map((point) => `${x(point.value).toFixed(1)} ${y(at(point, quantity.low)).toFixed(1)}`);
    const upper = run.map((point) => `${x(point.value).toFixed(1)} ${y(at(point, quantity.high)).toFixed(1)}`);
    return `M${lower.join("L")}L${upper.reverse().join("L")}Z`;
  }).join("");
  const bands = [true, false].map((ofLayers) => svg("path", { d: partsOfCurve(points).filter((part) => part.ofAtlas === ofLayers).map((part) => band(part.points)).join(""),
    class: `band band-${i} ${ofLayers ? "of-atlas" : "of-models"}` }));
  return [...bands,
    ...["rule", "mass", "layer", "atlas"].map((of) => svg("path", { d: path(points, quantity.of(of)), class: `line ${of} line-${i}` }))];
}

/// The points of a curve in stretches that the atlas, or the models outside of it, answer.
function partsOfCurve(points) {
  const parts = [];
  for (const point of points) {
    const inAtlas = point.answer.model === ofAtlas, last = parts[parts.length - 1];
    if (last && last.ofAtlas === inAtlas) last.points.push(point);
    else parts.push({ ofAtlas: inAtlas, points: [point] });
  }
  return parts;
}

/// Says why the band has a gap; nothing where it has none.
function showGap() {
  const curve = curves[page.active], parts = curve ? partsOfCurve(curve.points.filter(Boolean)) : [], inside = parts.filter((one) => one.ofAtlas);
  if (parts.length < 2 || inside.length === 0) { put("gap-text", ""); return; }
  const ends = inside.map(({ points }) => `${showNumber(points[0].value)} ${say("to")} ${showNumber(points[points.length - 1].value)}`).join(", ");
  const outside = parts.find((one) => !one.ofAtlas).points[0].answer.model;
  put("gap-text", say("band_gap", axisTitle(page.curveAxis), ends, say(modelWords[outside])));
}

/// Stretches of a list in which all are good.
function runsOf(list, good) {
  const runs = [[]];
  for (const one of list) { if (good(one)) runs[runs.length - 1].push(one); else if (runs[runs.length - 1].length > 0) runs.push([]); }
  return runs.filter((run) => run.length > 1);
}

function markPart(one, x, y) {
  const cx = x(one.x), bar = one.bar > 0 ? [svg("line", { x1: cx, x2: cx, y1: y(one.y - one.bar), y2: y(one.y + one.bar), class: "bar" })] : [];
  const shape = one.kind === "measured" ? svg("path", { d: `M${cx - 5} ${y(one.y)}h10M${cx} ${y(one.y) - 5}v10`, class: "measured-mark" })
    : svg("circle", { cx, cy: y(one.y), r: 4.5 });
  return svg("g", { class: `mark ${one.kind}` }, ...bar, shape, svg("title", {}, one.title));
}

function pointsOnCurve() { return [...casePoints(), ...measuredPoints()]; }

function showCurveLegend() {
  const drawn = curves.slice(0, page.machines.length).flatMap((curve) => (curve ? curve.points.filter(Boolean) : []));
  const isShown = { "band of-atlas": drawn.some(({ answer }) => answer.model === ofAtlas), band: drawn.some(({ answer }) => answer.model !== ofAtlas) };
  for (const of of ["atlas", "layer", "mass", "rule"]) isShown[of] = drawn.some(({ answer }) => Number.isFinite(answer[quantityOf().of(of)]));
  const entries = [["atlas", "by_atlas"], ["layer", "by_layer"], ["mass", "by_mass"], ["rule", "by_rule"], ["band of-atlas", "band_atlas"], ["band", "band_models"], ["own", "your_point"]];
  if (wantedFlows().length > 0) entries.push(["asked", "asked_line"]);
  if (page.cases.length > 0) entries.push(["simulated", "simulated_same"], ["simulated other", "simulated_other"]);
  if (page.measured && page.measured.points.length > 0) entries.push(["measured", "measured"]);
  document.getElementById("curve-legend").replaceChildren(...entries.filter(([key]) => isShown[key] !== false).map(([key, word]) => make("li", {}, make("span", { class: `key ${key}`, "aria-hidden": "true" }), say(word))));
  const answer = page.answers[page.active];
  put("curve-text", answer ? `${axisTitle(page.curveAxis)} ${fieldNumber(machine()[page.curveAxis])}: ${["atlas", "layer", "mass"].map((of) => `${say(`by_${of}`)} ${speedText(answer[`${of}_speed`])}`).join(", ")}.` : "");
}
