// The map of modes over two inputs, with the machines as points.

const mapSize = { columns: 96, rows: 60 };
// Okabe and Ito's colours for the modes that are met most; others take the next free colour.
const usualColours = { R: "#9aa5b1", PN: "#009E73", RP: "#8fd3b6", RPRN: "#b8e0a0", RPN: "#5e9c44", "FN'": "#E69F00", "FN'P": "#F0E442", "FP'N": "#56B4E9", "FP'NP": "#0072B2",
  FRP: "#CC79A7", "FP'": "#D55E00", F: "#8c6bb1" };
const freeColours = ["#b15928", "#4d6dd1", "#c9a0dc", "#7a9e9f", "#e78ac3"];
const otherColour = "#6b7078";
const map = { key: "", row: 0, rows: [], colours: new Map(), cells: document.createElement("canvas") };

function mapKey() {
  return JSON.stringify([page.mapX, page.mapY, page.mapModel, axisRange(page.mapX), axisRange(page.mapY), { ...machine(), [page.mapX]: 0, [page.mapY]: 0 }, page.active]);
}

/// Rows from the coarse to the fine, as long as there is time. @return whether the map is complete
function growMap(until) {
  const key = mapKey();
  if (map.key !== key) Object.assign(map, { key, row: 0, rows: new Array(mapSize.rows).fill(null) });
  const [xFrom, xTo] = axisRange(page.mapX), [yFrom, yTo] = axisRange(page.mapY), before = map.row;
  while (map.row < mapSize.rows && performance.now() < until) {
    const j = mapOrder[map.row], value = yFrom + (yTo - yFrom) * (j + 0.5) / mapSize.rows;
    const half = (xTo - xFrom) / mapSize.columns / 2;
    try {
      map.rows[j] = page.theory.mapRow({ ...machine(), [page.mapY]: value }, page.mapX, xFrom + half, xTo - half, mapSize.columns, page.mapModel === "layer");
    } catch (error) {
      map.rows[j] = new Array(mapSize.columns).fill({ efficiency: NaN, speed: NaN, mode: "" });
    }
    map.row += 1;
  }
  if (map.row !== before) drawMap();
  return map.row === mapSize.rows;
}
const mapOrder = spreadOrder(mapSize.rows);

function colourOf(mode) {
  if (mode in usualColours) return usualColours[mode];
  if (!map.colours.has(mode) && map.colours.size < freeColours.length) map.colours.set(mode, freeColours[map.colours.size]);
  return map.colours.get(mode) || otherColour;
}

/// What a cell of the map counts as.
function classOf(mode) { return mode === "" || mode === "violent" || colourOf(mode) !== otherColour ? mode : "other"; }

/// A canvas with sharp lines on every screen. @return its context and size in CSS pixels
function sharpCanvas(id, ratio, tallest) {
  const canvas = document.getElementById(id), width = Math.max(240, canvas.parentNode.clientWidth), height = Math.min(tallest, width * ratio);
  const scale = window.devicePixelRatio || 1;
  if (canvas.width !== Math.round(width * scale) || canvas.height !== Math.round(height * scale)) {
    canvas.width = Math.round(width * scale);
    canvas.height = Math.round(height * scale);
    canvas.style.height = `${height}px`;
  }
  const context = canvas.getContext("2d"), style = getComputedStyle(document.documentElement);
  context.setTransform(scale, 0, 0, scale, 0, 0);
  context.clearRect(0, 0, width, height);
  return { context, width, height, colour: (name) => style.getPropertyValue(`--${name}`).trim() };
}

const mapFrame = { left: 52, right: 10, above: 8, below: 40 };

function drawMap() {
  const { context, width, height, colour } = sharpCanvas("map", 0.62, 420), { left, right, above, below } = mapFrame;
  const inner = width - left - right, tall = height - above - below;
  const fills = { "": colour("line"), violent: colour("back"), other: otherColour };
  if (map.painted !== `${map.key}${map.row}${fills[""]}`) paintCells(fills);
  context.imageSmoothingEnabled = false;
  context.drawImage(map.cells, left, above, inner, tall);
  drawMapAxes(context, { width, height, inner, tall, colour });
  page.machines.forEach((one, k) => drawEfficiency(context, one, k, inner, tall));
  showMapLegend();
}

/// One pixel for each point, which drawMap() enlarges; and how many points each mode has.
function paintCells(fills) {
  Object.assign(map.cells, { width: mapSize.columns, height: mapSize.rows });
  const context = map.cells.getContext("2d");
  map.counts = new Map();
  map.rows.forEach((row, j) => {
    const filled = row || nearestRow(j);
    if (filled) filled.forEach(({ mode }, i) => {
      const kind = classOf(mode);
      map.counts.set(kind, (map.counts.get(kind) || 0) + 1);
      context.fillStyle = fills[kind] || colourOf(kind);
      context.fillRect(i, mapSize.rows - 1 - j, 1, 1);
    });
  });
  map.painted = `${map.key}${map.row}${fills[""]}`;
}

function nearestRow(j) {
  for (let distance = 1; distance < mapSize.rows; ++distance) {
    const row = map.rows[j - distance] || map.rows[j + distance];
    if (row) return row;
  }
  return null;
}

function drawMapAxes(context, { height, inner, tall, colour }) {
  const { left, above } = mapFrame, ranges = [axisRange(page.mapX), axisRange(page.mapY)];
  context.fillStyle = colour("quiet");
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (const value of ticks(...ranges[0], 5)) context.fillText(fieldNumber(value), left + (value - ranges[0][0]) / (ranges[0][1] - ranges[0][0]) * inner, above + tall + 15);
  context.fillText(axisTitle(page.mapX), left + inner / 2, height - 5);
  context.textAlign = "right";
  for (const value of ticks(...ranges[1], 5)) context.fillText(fieldNumber(value), left - 5, above + tall - (value - ranges[1][0]) / (ranges[1][1] - ranges[1][0]) * tall + 4);
  context.save();
  context.translate(12, above + tall / 2);
  context.rotate(-Math.PI / 2);
  context.textAlign = "center";
  context.fillText(axisTitle(page.mapY), 0, 0);
  context.restore();
}

function drawEfficiency(context, one, k, inner, tall) {
  const [xFrom, xTo] = axisRange(page.mapX), [yFrom, yTo] = axisRange(page.mapY), { left, above } = mapFrame;
  const x = left + (one[page.mapX] - xFrom) / (xTo - xFrom) * inner, y = above + tall - (one[page.mapY] - yFrom) / (yTo - yFrom) * tall;
  context.beginPath();
  context.arc(x, y, 7, 0, 2 * Math.PI);
  context.fillStyle = "#fff";
  context.fill();
  context.lineWidth = 3;
  context.strokeStyle = "#000";
  context.stroke();
  if (page.machines.length < 2) return;
  context.fillStyle = "#000";
  context.textAlign = "center";
  context.font = "bold 10px system-ui, sans-serif";
  context.fillText("AB"[k], x, y + 3.5);
}

const letterWords = { F: "mode_F", P: "mode_P", N: "mode_N", R: "mode_R" };

/// "thrown, forwards, backwards" for FP'N
function modeWords(mode) {
  if (mode === "") return say("mode_none");
  if (mode === "other") return say("mode_other");
  if (mode === "violent") return say("mode_violent", page.theory.names.largest_usual_machine_number);
  const letters = mode.replace(/['.]/g, "").split("");
  return letters.slice(0, 5).map((letter) => say(letterWords[letter])).join(", ") + (letters.length > 5 ? " \u2026" : "");
}

function showMapLegend() {
  const shown = [...map.counts].sort((a, b) => b[1] - a[1]).slice(0, 9);
  document.getElementById("map-legend").replaceChildren(...shown.map(([mode]) => {
    const key = make("span", { class: "key fill", "aria-hidden": "true" });
    const special = { "": "var(--line)", violent: "var(--back)", other: otherColour };
    key.style.background = special[mode] || colourOf(mode);
    return make("li", {}, key, ...(mode in special ? [] : [make("b", {}, mode)]), ` ${modeWords(mode)}`);
  }));
  const answer = page.answers[page.active];
  put("map-text", answer ? `${axisTitle(page.mapX)} ${fieldNumber(machine()[page.mapX])}, ${axisTitle(page.mapY)} ${fieldNumber(machine()[page.mapY])}: ${answer[`${page.mapModel}_mode`] || say("mode_none")}. ${say("map_hint")}` : "");
}

/// Sets both inputs to the place that was clicked.
function clickMap(event) {
  const canvas = event.currentTarget, box = canvas.getBoundingClientRect(), { left, right, above, below } = mapFrame;
  const place = (axis, part) => {
    const [from, to] = axisRange(axis), { step, low, high } = settingNamed[axis];
    return Math.min(high, Math.max(low, Number((Math.round((from + (to - from) * Math.min(1, Math.max(0, part))) / step) * step).toPrecision(6))));
  };
  const x = (event.clientX - box.left - left) / (box.width - left - right), y = 1 - (event.clientY - box.top - above) / (box.height - above - below);
  setValue(page.mapX, place(page.mapX, x));
  setValue(page.mapY, place(page.mapY, y));
}
