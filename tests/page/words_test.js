// Words and numbers of the page, without a browser: both languages have the same words, and the theory's sentences are all known.
// usage: node words_test.js PARTS
"use strict";
const fs = require("fs"), path = require("path"), vm = require("vm"), assert = require("assert");
const parts = process.argv[2];
const scope = vm.createContext({ page: { language: "en" } });
const source = ["german", "words", "numbers"].map((name) => fs.readFileSync(path.join(parts, `${name}.js`), "utf8")).join("\n");
vm.runInContext(`${source}\nglobalThis.all = { englishWords, germanWords, say, sayTheory, parseNumber, showNumber, fieldNumber };`, scope);
const { englishWords, germanWords, sayTheory, parseNumber, showNumber, fieldNumber } = scope.all;

const keys = Object.keys(englishWords), places = (text) => [...new Set(text.match(/\{\d\}/g) || [])].sort().join("");
assert.deepStrictEqual(Object.keys(germanWords), keys);
for (const key of keys) assert.strictEqual(places(germanWords[key]), places(englishWords[key]), key);

// What a script or the page asks for is there.
const asked = fs.readdirSync(parts).filter((name) => /\.(js|html)$/.test(name)).flatMap((name) =>
  [...fs.readFileSync(path.join(parts, name), "utf8").matchAll(/\bsay\("([a-z_]\w*)"|data-word="(\w+)"/g)].map((found) => found[1] || found[2]));
assert(asked.length > 60);
for (const key of asked) assert(keys.includes(key), `there is no word ${key}`);

for (const [text, value] of [["9.7", 9.7], ["9,7", 9.7], [" 1 234,5 ", 1234.5], ["1.234,5", 1234.5], ["1,234.5", 1234.5], ["1,234", 1.234], ["\u22125", -5], [".5", 0.5],
  ["1e3", 1000], ["-0,08", -0.08]]) assert.strictEqual(parseNumber(text), value, text);
for (const text of ["", "nine", "9.7 mm", "1..2", "--1", "0x10", "Infinity", "1,2,3"]) assert(Number.isNaN(parseNumber(text)), text);
assert.deepStrictEqual([0.39663, 1234.5, 0, -0.0004, 5e-6, NaN].map((value) => showNumber(value)), ["0.397", "1235", "0", "\u22120.000400", "5.00e\u22126", "\u2013"]);
assert.strictEqual(showNumber(0.39663, 3, "de"), "0,397");
assert.strictEqual(fieldNumber(0.1 + 0.2, "en"), "0.3");

// As tested_range.cpp, unusual.cpp, machine.cpp and the atlas (value.cpp) write them.
const sentences = ["the rolling-layer law has not been tested at tan_vibration_angle = 0.9 (41.99 deg), outside [0.35, 0.75] (19.29 to 36.87 deg)",
  "the rolling-layer law has not been tested at a depth in diameters of the grains = 40, outside [3, 16]",
  "the rolling-layer law has not been tested at throw_number = 0.9, tan_inclination = 0.02 (1.146 deg), a depth in diameters of the grains = 4, where it has been for throw numbers in [1.3, 2.5]",
  "the rolling-layer law has not been tested at throw_number = 2, tan_inclination = 0.07 (4.004 deg), a depth in diameters of the grains = 12",
  "rolling_friction 0.25 (the atlas has 0 to 0.2)", "depth 30 (the atlas has 3 to 20)",
  "the material runs away", "no simulated layer tells what the model misses here",
  "a frequency of 960 Hz is unusual: vibrating troughs run at 1 to 120 Hz; were 960 turns per minute meant (rpm)?",
  "a frequency of 0.5 Hz is unusual: vibrating troughs run at 1 to 120 Hz; were 30 Hz meant, not rpm?",
  "an amplitude of 80 mm is unusual: strokes, which are twice the amplitude, are mostly below 30 mm; were mm meant, not m?",
  "a machine number of 12 is unusual: troughs bear 3 to 6 times gravity; was the stroke given as the amplitude, which is half of it?",
  "a friction coefficient of 30 is unusual: it is mostly 0.1 to 1; was an angle of friction meant (its tangent is 0.577), or 30 %?"];
for (const language of ["en", "de"]) {
  scope.page.language = language;
  for (const sentence of sentences) {
    const said = sayTheory(sentence);
    assert.notStrictEqual(said, sentence);
    assert(!/undefined|NaN|\{|_/.test(said), said);
  }
}
scope.page.language = "de";
assert(sayTheory(sentences[2]).startsWith("Wurfkennziffer 0,900 (tan der Neigung 0,0200, H\u00f6he in K\u00f6rnern 4,00): "));
console.log(`${keys.length} words in two languages, ${asked.length} places that ask for them, ${sentences.length} sentences of the theory`);
