// Fields, sliders and buttons of the inputs.

const poles = [[2, 50], [4, 50], [6, 50], [2, 60], [4, 60], [6, 60]];

/// An element with attributes and content. Functions become listeners; words are filled in by translate().
function make(tag, attributes = {}, ...content) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name, value);
    else if (value !== null) element.setAttribute(name, value);
  }
  element.append(...content);
  return element;
}

function makeField(id, name, label, onInput) {
  return make("input", { id, type: "text", inputmode: "decimal", autocomplete: "off", spellcheck: "false", "aria-describedby": `${id}-wrong`, "aria-labelledby": label,
    input: (event) => onInput(event.target), blur: () => fillFields() });
}

/// A row of the inputs: label, field with unit, slider, and a place for what is wrong.
function makeRow(setting) {
  const { name } = setting, label = `label-${name}`;
  const field = makeField(name, name, label, (target) => takeField(target, name, 1));
  const slider = make("input", { type: "range", id: `slide-${name}`, "aria-labelledby": label, min: setting.from, max: setting.to, step: setting.step,
    input: (event) => { setValue(name, Number(event.target.value)); } });
  const line = make("div", { class: "field" }, field, make("span", { class: "unit", "data-unit": name }));
  const row = make("div", { class: "row", id: `row-${name}` }, make("label", { id: label, for: name, "data-word": name }), line, slider,
    make("p", { class: "wrong", id: `${name}-wrong`, role: "alert" }));
  if (name === "stroke_mm") {
    const amplitude = makeField("amplitude_mm", "amplitude_mm", "label-amplitude_mm", (target) => takeField(target, "stroke_mm", 2));
    line.append(make("span", { class: "beside", id: "label-amplitude_mm", "data-word": "amplitude_mm" }), amplitude, make("span", { class: "unit" }, "mm"));
    row.append(make("p", { class: "wrong", id: "amplitude_mm-wrong", role: "alert" }));
  }
  if (name === "rpm") row.append(makePoles());
  if (name === "rolling_friction") row.append(make("p", { class: "note", "data-word": "rolling_note" }));
  return row;
}

function makePoles() {
  const buttons = poles.map(([count, hertz]) => make("button", { type: "button", "data-poles": `${count},${hertz}`,
    click: () => setValue("rpm", 120 * hertz / count) }));
  return make("div", {}, make("div", { class: "poles", role: "group", "aria-labelledby": "label-rpm" }, ...buttons), make("p", { class: "note", "data-word": "poles_note" }));
}

/// What is wrong with a text for a setting, or nothing.
function wrongWith(text, { low, high, start }, factor) {
  const value = factor * parseNumber(text), example = fieldNumber(start / factor);
  if (Number.isNaN(value)) return say("wrong_number", text, example);
  if (value < low || value > high) return say("wrong_range", text.trim(), fieldNumber(low / factor), fieldNumber(high / factor), example);
  return "";
}

/// Reads a field that was typed in. @param factor  of the number to the setting
function takeField(field, name, factor) {
  const problem = wrongWith(field.value, settingNamed[name], factor);
  field.setAttribute("aria-invalid", problem ? "true" : "false");
  document.getElementById(`${field.id}-wrong`).textContent = problem;
  page.wrong.delete(field.id);
  if (problem) {
    page.wrong.add(field.id);
    changed();
  } else {
    setValue(name, factor * parseNumber(field.value), field);
  }
}

/// Sets a value of the machine that is edited, and everything that shows it but the field that is typed in.
function setValue(name, value, typed = null) {
  machine()[name] = value;
  for (const id of name === "stroke_mm" ? [name, "amplitude_mm"] : [name]) {
    if (typed && typed.id === id) continue;
    clearWrong(id);
  }
  fillFields(typed);
  changed();
}

function clearWrong(id) {
  page.wrong.delete(id);
  document.getElementById(id).setAttribute("aria-invalid", "false");
  document.getElementById(`${id}-wrong`).textContent = "";
}

/// Writes the values into fields and sliders; a field with a mistake keeps its text.
function fillFields(typed = null) {
  for (const { name } of settings) {
    const value = machine()[name], field = document.getElementById(name), slider = document.getElementById(`slide-${name}`);
    if (field !== typed && !page.wrong.has(name)) field.value = fieldNumber(value);
    slider.value = value;
    slider.setAttribute("aria-valuetext", `${fieldNumber(value)} ${unitOf(settingNamed[name])}`);
  }
  const amplitude = document.getElementById("amplitude_mm");
  if (amplitude !== typed && !page.wrong.has("amplitude_mm")) amplitude.value = fieldNumber(machine().stroke_mm / 2);
  for (const button of document.querySelectorAll("[data-poles]")) {
    const [count, hertz] = button.dataset.poles.split(",").map(Number);
    button.setAttribute("aria-pressed", String(machine().rpm === 120 * hertz / count));
  }
}

function makeInputs() {
  for (const group of ["machine", "material", "layer"]) {
    const rows = settings.filter((one) => one.group === group).map(makeRow);
    document.getElementById("inputs").append(make("fieldset", {}, make("legend", { "data-word": group }), ...rows));
  }
}
