// The user's measured points, pasted from a spreadsheet.

const speedColumns = { "speed_m_per_s": 1, "speed_m_per_min": 1 / 60, "m/s": 1, "m/min": 1 / 60, "speed": null, "t/h": "flow", "mass_flow_t_per_h": "flow" };

/// Cells of a line: tabs, semicolons or blanks between them, so that a comma can be a decimal comma.
function cellsOf(line) {
  const separator = line.includes("\t") ? /\t+/ : line.includes(";") ? /\s*;\s*/ : /\s+/;
  return line.trim().split(separator).map((cell) => cell.trim()).filter((cell) => cell !== "");
}

/// @return {axis, quantity, factor, points, problems} of a pasted text
function readMeasured(text) {
  const result = { axis: page.curveAxis, quantity: page.curveQuantity, factor: page.curveQuantity === "speed" ? 1 / speedFactor() : 1, points: [], problems: [] };
  text.split(/\r?\n/).forEach((line, i) => {
    const cells = cellsOf(line);
    if (cells.length === 0 || /^(#|sep=)/.test(line)) return;
    const numbers = cells.map(parseNumber);
    if (i === 0 && numbers.every(Number.isNaN)) { readHeader(cells, result); return; }
    if (numbers.length < 2 || numbers.length > 3 || numbers.some(Number.isNaN)) {
      if (result.problems.length < 3) result.problems.push(say("measured_wrong", i + 1, line.trim().slice(0, 40)));
      return;
    }
    result.points.push({ x: numbers[0], y: numbers[1] * result.factor, bar: Math.abs(numbers[2] || 0) * result.factor });
  });
  return result;
}

function readHeader([axis, quantity], result) {
  if (axisNames.includes(axis)) result.axis = axis;
  else result.problems.push(say("measured_header", axis, axisNames.join(", ")));
  if (quantity === undefined) return;
  const unit = speedColumns[quantity];
  if (unit === undefined) result.problems.push(say("measured_header", quantity, Object.keys(speedColumns).join(", ")));
  else if (unit === "flow") Object.assign(result, { quantity: "flow", factor: 1 });
  else Object.assign(result, { quantity: "speed", factor: unit === null ? 1 / speedFactor() : unit });
}

/// Takes the pasted text; the picture goes over to the axis of its header.
function takeMeasured() {
  const text = document.getElementById("measured").value;
  page.measured = text.trim() === "" ? null : readMeasured(text);
  if (page.measured) { page.curveAxis = page.measured.axis; page.curveQuantity = page.measured.quantity; fillChoices(); }
  showMeasuredNote();
  changed();
}

function showMeasuredNote() {
  const { measured } = page;
  const notes = measured ? [...measured.problems, say("measured_count", measured.points.length)] : [];
  if (measured && measured.axis !== page.curveAxis) notes.push(say("measured_axis", say(measured.axis)));
  const [from, to] = axisRange(page.curveAxis), outside = measuredPoints().filter(({ x }) => x < from || x > to).length;
  if (outside > 0) notes.push(say("measured_outside", outside));
  put("measured-note", notes.join(" "));
  document.getElementById("measured-note").classList.toggle("wrong", Boolean(measured && measured.problems.length > 0));
  put("measured-help", say("measured_help", page.curveQuantity === "speed" ? page.speedUnit : "t/h"));
}

function measuredPoints() {
  const { measured } = page;
  if (!measured || measured.axis !== page.curveAxis || measured.quantity !== page.curveQuantity) return [];
  const factor = measured.quantity === "speed" ? speedFactor() : 1;
  return measured.points.map(({ x, y, bar }) => ({ kind: "measured", x, y: y * factor, bar: bar * factor, title: `${say("measured")}: ${showNumber(y * factor)}` }));
}
