// All functions of the page, compiled for browsers, against the same functions compiled for this machine.
// usage: node compare_native.js THEORY_JS NATIVE_ANSWERS WORK PARTS COUNT
"use strict";
const fs = require("fs"), path = require("path"), vm = require("vm"), assert = require("assert"), { execFileSync } = require("child_process");
const [script, native, work, parts, number] = process.argv.slice(2);
const COUNT = Number(number), FRAMES = 9, ROW = 20, CURVE = 10, EVERY = 100;
// musl and glibc round sines, tangents and square roots of sums differently in the last bit, and the solver's Newton steps
// carry that on: its own error is below 1e-9 (src/theory/point_mass.hpp) of velocity efficiency, and so of the mass flow at
// an efficiency of 1.
const TOLERANCE = 1e-9;

/// Numbers in [0, 1) that are the same on every machine.
function makeRandom(seed) {
  let state = BigInt(seed);
  return () => {
    state = (state * 6364136223846793005n + 1442695040888963407n) & 0xffffffffffffffffn;
    return Number(state >> 11n) / 2 ** 53;
  };
}

/// stroke, rpm, angle, inclination, friction, band, rolling friction, grain, depth, width, density. The machine number,
/// from which the rpm follow, is that of all machines that are not unusual (src/theory/unusual.hpp). Every second one has its
/// other numbers mostly within the ranges of the atlas (src/atlas/tables.cpp). About one in 20,000 lies so close to a doubling of the period
/// that rounding decides it; these seeds have none.
function randomSettings() {
  const anywhere = makeRandom(20261126), inAtlas = makeRandom(20261128);
  const one = (_, i) => {
    const atlas = i % 2 === 1, random = atlas ? inAtlas : anywhere, between = (a, b) => a + (b - a) * random();
    const stroke = between(1, 20), rpm = 30 / Math.PI * Math.sqrt(between(0.2, 9) * 9.81 / (stroke / 2000));
    const drive = atlas ? [between(17, 45), between(-5.5, 5.5), between(0.15, 0.6)] : [between(5, 60), between(-8, 8), between(0.05, 0.9)];
    const frictions = [random() < 0.3 ? 0 : between(0, 0.05), random() < 0.5 ? 0 : between(0, atlas ? 0.2 : 0.3)];
    const grain = atlas ? stroke / between(1, 8) : between(0.5, 10), depth = atlas ? grain * between(3, 20) : between(2, 120);
    return [stroke, rpm, ...drive, ...frictions, grain, depth, between(50, 2000), between(200, 3000)];
  };
  return Float64Array.from(Array.from({ length: COUNT }, one).flat());
}

class Tally {
  constructor(name) { Object.assign(this, { name, equal: 0, count: 0, worst: 0 }); }
  add(ours, theirs, scale, where) {
    this.count += 1;
    if (Object.is(ours, theirs) || ours === theirs) { this.equal += 1; return; }
    const difference = Math.abs(ours - theirs) / Math.max(scale, Math.abs(theirs));
    assert(difference <= TOLERANCE, `${this.name}: ${ours} here, ${theirs} natively, at ${where}`);
    this.worst = Math.max(this.worst, difference);
  }
  toString() {
    return `${this.name}: ${this.count} numbers, ${(100 * this.equal / this.count).toFixed(2)} % equal to the last bit, largest difference ${this.worst.toExponential(1)}`;
  }
}

function call(theory, input, settings, size, output, run) {
  theory.HEAPF64.set(settings, input / 8);
  theory.HEAPF64.fill(0, output / 8, output / 8 + size);
  const failed = run() !== 0;
  return failed ? new Float64Array(size).fill(NaN) : theory.HEAPF64.slice(output / 8, output / 8 + size);
}

function compareNumbers(tally, ours, theirs, skipped, scaleOf, where) {
  for (let i = 0; i < ours.length; ++i) if (!skipped(i)) tally.add(ours[i], theirs[i], scaleOf(i), `${where}, number ${i}`);
}

/// Whether number i of answers is that of a motion without a period: a mean over cycles of which the last bit of the first
/// decides the later ones. Both sides have to find no period.
function withoutPeriod(names, ours, theirs) {
  const at = (numbers, i, name) => numbers[Math.floor(i / names.length) * names.length + names.indexOf(name)];
  const none = (i, of) => at(ours, i, `${of}_mode`) === 0 && at(theirs, i, `${of}_mode`) === 0;
  return (i) => {
    const of = names[i % names.length].split("_")[0];
    // The trend of the atlas is made of both models.
    if (of === "best") return [["layer"], ["mass"], ["mass", "layer"], ["mass", "layer"]][at(ours, i, "model")].some((one) => none(i, one));
    if (of === "atlas") return none(i, "mass") || none(i, "layer");
    return ["mass", "layer"].includes(of) && none(i, of);
  };
}

/// What a difference of number i of answers is compared with: 1, or the mass flow at an efficiency of 1.
function scalesOf(names, known) {
  return (i) => {
    const [of, flow] = names[i % names.length].split("_"), first = i - i % names.length;
    if (flow !== "flow" || of === "rule") return 1;
    const scale = Math.abs(known[first + names.indexOf(`${of}_flow`)] / known[first + names.indexOf(`${of}_efficiency`)]);
    return Number.isFinite(scale) ? Math.max(1, scale) : 1;
  };
}

/// The texts with numbers taken out, and the numbers.
function takenApart(json) {
  const numbers = [];
  const text = json.replace(/-?\d+\.?\d*(e[-+]\d+)?/g, (number) => { numbers.push(Number(number)); return "#"; });
  return { text, numbers };
}

/// What the page says for a sentence of the theory, in German.
function germanSpeaker() {
  const scope = vm.createContext({ page: { language: "de" } });
  const source = ["german", "words", "numbers"].map((name) => fs.readFileSync(path.join(parts, `${name}.js`), "utf8")).join("\n");
  return vm.runInContext(`${source}\nsayTheory`, scope);
}

main().catch((error) => { console.error(error.message); process.exit(1); });

async function main() {
  const file = (name) => path.join(work, name), files = ["settings", "answers", "frames", "rows", "curves", "words", "modes"].map(file);
  fs.mkdirSync(work, { recursive: true });
  files.forEach((one) => fs.rmSync(one, { force: true }));
  const settings = randomSettings();
  fs.writeFileSync(files[0], Buffer.from(settings.buffer));
  execFileSync(native, files, { stdio: "inherit" });
  const doubles = (one) => { const b = fs.readFileSync(one); return new Float64Array(b.buffer.slice(b.byteOffset, b.byteOffset + b.length)); };
  const [answers, frames, rows, curves] = files.slice(1, 5).map(doubles);
  const words = fs.readFileSync(files[5], "utf8").trimEnd().split("\n"), modes = ["", ...fs.readFileSync(files[6], "utf8").trimEnd().split("\n")];
  const theory = await require(path.resolve(script))({ wasmBinary: fs.readFileSync(script.replace(/js$/, "wasm")) });
  const text = (pointer) => theory.UTF8ToString(pointer);
  const names = JSON.parse(text(theory._page_names())), width = names.answer.length, count = names.settings.length;
  assert.strictEqual(width, 40, "native_answers.cpp has this number, too");
  theory._page_prepare_atlas();
  const input = theory._malloc(8 * count), output = theory._malloc(8 * width * CURVE * 10);
  const isMode = (i) => names.answer[i % width].endsWith("_mode");
  const inGerman = germanSpeaker(), said = new Set();
  let unsettled = 0, inAtlas = 0;
  const tallies = ["answers", "frames", "rows of maps", "curves", "numbers in words"].map((name) => new Tally(name));
  const sameModes = (ours, theirs, positions, where) => positions.forEach((i) => {
    if (Number.isNaN(theirs[i]) && Number.isNaN(ours[i])) return;
    assert.strictEqual(text(theory._page_mode(ours[i])), modes[theirs[i]], `mode at ${where}`);
  });
  const modePositions = (n, test) => Array.from({ length: n }, (_, i) => i).filter(test);
  for (let i = 0; i < COUNT; ++i) {
    const one = settings.subarray(i * count, (i + 1) * count), where = `[${one}]`;
    const get = (size, run) => call(theory, input, one, size, output, run);
    const answer = get(width, () => theory._page_answer(input, output)), known = answers.subarray(i * width, (i + 1) * width);
    const free = withoutPeriod(names.answer, answer, known);
    unsettled += ["mass", "layer"].filter((of) => free(names.answer.indexOf(`${of}_efficiency`))).length;
    inAtlas += Number.isFinite(answer[names.answer.indexOf("atlas_speed")]) ? 1 : 0;
    compareNumbers(tallies[0], answer, known, (k) => isMode(k) || free(k), scalesOf(names.answer, known), where);
    sameModes(answer, known, modePositions(width, isMode), where);
    for (const rolling of [0, 1]) {
      const size = 8 * FRAMES, from = (2 * i + rolling) * size;
      const frame = get(size, () => theory._page_frames(input, rolling, FRAMES, output));
      // Forces are in N/kg, and a sample at the border between two phases may belong to either.
      const theirs = frames.subarray(from, from + size), border = (k) => frame[8 * k + 1] !== theirs[8 * k + 1];
      compareNumbers(tallies[1], frame, theirs, (k) => border(Math.floor(k / 8)), (k) => (k % 8 > 5 ? 1 : 1e-3), where);
    }
    theory.HEAPF64.set(one, input / 8);
    const ours = takenApart(text(theory._page_words(input))), theirs = takenApart(words[i]);
    assert.strictEqual(ours.text, theirs.text);
    const { untested, unusual, outside_atlas } = JSON.parse(words[i]);
    for (const sentence of [...(untested ? [untested] : []), ...unusual, ...outside_atlas]) {
      assert.notStrictEqual(inGerman(sentence), sentence, "the page knows every sentence of the theory");
      said.add(inGerman(sentence).replace(/[\d,]+/g, "#"));
    }
    compareNumbers(tallies[4], ours.numbers, theirs.numbers, () => false, () => 1, where);
    if (i % EVERY) continue;
    for (const rolling of [0, 1]) {
      const from = (2 * i / EVERY + rolling) * 4 * ROW, row = rows.subarray(from, from + 4 * ROW);
      const found = get(4 * ROW, () => theory._page_map_row(input, 0, 2, 14, ROW, rolling, output));
      const none = (k) => k % 4 < 2 && found[k - k % 4 + 2] === 0 && row[k - k % 4 + 2] === 0;
      compareNumbers(tallies[2], found, row, (k) => k % 4 === 2 || none(k), () => 1, where);
      sameModes(found, row, modePositions(4 * ROW, (k) => k % 4 === 2), where);
    }
    const from = i / EVERY * width * CURVE;
    const curve = get(width * CURVE, () => theory._page_curve(input, 1, 500, 1500, CURVE, output));
    const theirCurve = curves.subarray(from, from + width * CURVE), skip = withoutPeriod(names.answer, curve, theirCurve);
    compareNumbers(tallies[3], curve, theirCurve, (k) => isMode(k) || skip(k), scalesOf(names.answer, theirCurve), where);
  }
  console.log(`${unsettled} of ${2 * COUNT} motions have no period on either side and are not compared`);
  assert(unsettled < 0.1 * 2 * COUNT);
  console.log(`${inAtlas} of ${COUNT} layers lie inside of the atlas`);
  assert(inAtlas > 0.1 * COUNT);
  assert(said.size >= 6, [...said].join("\n"));
  tallies.forEach((tally) => console.log(`${tally}`));
}
