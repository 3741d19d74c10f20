// Numbers as people write them: with a decimal point or comma, and back in the words' language.

/// The number in a text, or NaN. "1.234,5" and "1,234.5" are read as people mean them; "1,234" is 1.234, as on a German keyboard.
function parseNumber(text) {
  let plain = String(text).trim().replace(/[\s\u00a0\u202f']/g, "").replace("\u2212", "-");
  const point = plain.lastIndexOf("."), comma = plain.lastIndexOf(",");
  if (point >= 0 && comma >= 0) {
    const thousands = point > comma ? /,/g : /\./g;
    plain = plain.replace(thousands, "");
  }
  plain = plain.replace(",", ".");
  return /^[+-]?(\d+\.?\d*|\.\d+)(e[+-]?\d+)?$/i.test(plain) ? Number(plain) : NaN;
}

/// Three or so digits that matter, with the comma of German.
function showNumber(value, digits = 3, language = page.language) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "\u2013";
  const size = Math.abs(value);
  const places = size === 0 ? 0 : Math.max(0, digits - 1 - Math.floor(Math.log10(size)));
  let text = size !== 0 && size < 1e-4 ? value.toExponential(digits - 1) : value.toFixed(Math.min(places, 12));
  if (Number(text) === 0) text = text.replace("-", "");
  text = text.replace("-", "\u2212");
  return language === "de" ? text.replace(".", ",") : text;
}

/// For a field: all digits that were set, without rounding noise.
function fieldNumber(value, language = page.language) {
  const text = String(Number(value.toPrecision(6)));
  return language === "de" ? text.replace(".", ",") : text;
}

/// A range with its unit: "0.35 to 0.43 m/s".
function showRange(low, high, unit) {
  if (!Number.isFinite(low) || !Number.isFinite(high)) return say("not_known");
  return `${showNumber(low)} ${say("to")} ${showNumber(high)} ${unit}`;
}
