// All words of the page: English and German.

const words = {
  title: ["Vibrating trough", "Schwingrinne"],
  subtitle: ["How fast does it convey, and how sure is that?", "Wie schnell f\u00f6rdert sie, und wie sicher ist das?"],
  machine: ["Machine", "Maschine"], material: ["Material", "Gut"], layer: ["Layer", "Schicht"],
  stroke_mm: ["Stroke, peak to peak", "Schwingbreite (Hub), Spitze zu Spitze"], amplitude_mm: ["amplitude", "Amplitude"],
  rpm: ["Speed of the drive", "Drehzahl"], vibration_angle_deg: ["Drive angle to the trough", "Wurfwinkel zur Rinne"],
  inclination_deg: ["Inclination, uphill positive", "Neigung, bergauf positiv"],
  friction: ["Friction on the trough", "Reibungszahl an der Rinne"], friction_band: ["Friction uncertain by \u00b1", "Reibungszahl unsicher um \u00b1"],
  rolling_friction: ["Rolling friction of the grains", "Rollreibungszahl der K\u00f6rner"], grain_mm: ["Grain diameter", "Korndurchmesser"],
  depth_mm: ["Depth of the layer", "Schichth\u00f6he"], width_mm: ["Width of the trough", "Rinnenbreite"], bulk_density: ["Bulk density", "Sch\u00fcttdichte"],
  unit_rpm: ["rpm", "U/min"], unit_1: ["", ""],
  poles: ["{0} poles, {1} Hz", "{0}-polig, {1} Hz"],
  poles_note: ["Synchronous speeds; a loaded motor is 2 to 5 % slower.", "Synchrondrehzahlen; belastete Motoren sind 2 bis 5 % langsamer."],
  speed: ["Conveying speed", "F\u00f6rdergeschwindigkeit"], flow: ["Mass flow", "Massenstrom"], throw_number: ["Throw number \u0393", "Wurfkennziffer \u0393"],
  machine_number: ["Machine number K", "Maschinenkennziffer K"], landing_speed: ["Landing speed", "Auftreffgeschwindigkeit"],
  power: ["Power into the layer", "Leistung in die Schicht"], depth_in_grains: ["Depth in grains", "H\u00f6he in K\u00f6rnern"],
  efficiency: ["Velocity efficiency", "Geschwindigkeitswirkungsgrad"],
  by_mass: ["point mass", "Massenpunkt"], by_layer: ["rolling-layer law", "Gesetz der rollenden Schicht"], by_between: ["between both", "zwischen beiden"],
  model: ["Answer of", "Antwort von"],
  letters: ["\u0393 (gamma), the throw number, is the largest acceleration of the trough normal to itself over gravity\u2019s part normal to it: above 1 the material is thrown. Some shops call it K or K\u1d65. K here is the machine number, the largest acceleration in the direction of vibration in units of g: what the structure has to bear.",
    "\u0393 (Gamma), die Wurfkennziffer, ist die gr\u00f6\u00dfte Beschleunigung der Rinne senkrecht zu sich selbst, geteilt durch den Anteil der Schwere in dieser Richtung: \u00fcber 1 wird das Gut geworfen. Manche Betriebe nennen sie K oder K\u1d65. K ist hier die Maschinenkennziffer, die gr\u00f6\u00dfte Beschleunigung in Schwingrichtung in Einheiten von g: was der Rahmen aushalten muss."],
  in_g: ["g", "g"], not_known: ["not known", "nicht bekannt"], to: ["to", "bis"], none: ["none", "keine"],
  trust_0: ["tested", "gepr\u00fcft"], trust_1: ["at the edge of what was tested", "am Rand des Gepr\u00fcften"], trust_2: ["not tested", "nicht gepr\u00fcft"],
  trust_wrong: ["check the inputs", "Eingaben pr\u00fcfen"],
  wrong_note: ["The answer is that of the last inputs that were complete.", "Die Antwort ist die der letzten vollst\u00e4ndigen Eingaben."],
  tested_note: ["Within the range in which the model was compared with simulated layers.", "Im Bereich, in dem das Modell mit simulierten Schichten verglichen wurde."],
  band_note: ["Bands: the friction\u2019s uncertainty, widened by what the model missed in simulated layers (95 %).", "B\u00e4nder: Unsicherheit der Reibung, erweitert um die Abweichung des Modells von simulierten Schichten (95 %)."],
  what_it_does: ["What the layer does", "Was die Schicht tut"],
  is_thrown: ["thrown for {0} degrees of the cycle", "{0} Grad des Zyklus im Wurf"], lands: ["lands {0}", "landet {0}"],
  slides_f: ["slides forwards for {0}\u00b0", "gleitet {0}\u00b0 vorw\u00e4rts"], slides_b: ["slides backwards for {0}\u00b0", "gleitet {0}\u00b0 r\u00fcckw\u00e4rts"],
  rests: ["rests on the trough for {0}\u00b0", "ruht {0}\u00b0 auf der Rinne"], forwards: ["sliding forwards", "vorw\u00e4rts gleitend"], backwards: ["sliding backwards", "r\u00fcckw\u00e4rts gleitend"],
  resting: ["without sliding", "ohne zu gleiten"], flying: ["and takes off at once", "und hebt sofort wieder ab"], cycles: ["repeats after {0} cycles", "wiederholt sich nach {0} Zyklen"],
  no_period: ["moves without a period", "bewegt sich ohne Periode"], runs_away: ["runs away downhill: gravity exceeds friction", "rutscht ab: die Schwere ist gr\u00f6\u00dfer als die Reibung"],
  letters_of: ["in letters", "in Buchstaben"],
  picture_curve: ["Speed and mass flow over an input", "Geschwindigkeit und Massenstrom \u00fcber einer Eingabe"], across: ["Across", "Waagerecht"], upwards: ["Upwards", "Senkrecht"],
  your_point: ["your machine", "Ihre Maschine"], machine_a: ["machine A", "Maschine A"], machine_b: ["machine B", "Maschine B"], simulated: ["simulated", "simuliert"], measured: ["measured", "gemessen"],
  simulated_same: ["simulated, other inputs as yours", "simuliert, sonst wie Ihre Eingaben"], simulated_other: ["simulated, other inputs differ", "simuliert, andere Eingaben"],
  band: ["band", "Band"],
  picture_map: ["Map of modes", "Karte der Bewegungsformen"], map_model: ["Model", "Modell"], map_hint: ["A click sets both inputs.", "Ein Klick setzt beide Eingaben."],
  mode_F: ["thrown", "Wurf"], mode_P: ["forwards", "vorw\u00e4rts"], mode_N: ["backwards", "r\u00fcckw\u00e4rts"], mode_R: ["rest", "Ruhe"], mode_none: ["no period", "ohne Periode"], mode_other: ["other modes", "andere Bewegungsformen"],
  mode_violent: ["machine number above {0}: no trough bears it", "Maschinenkennziffer \u00fcber {0}: das ertr\u00e4gt keine Rinne"], cut_off: ["Landing peaks are cut off.", "Spitzen der Landung sind abgeschnitten."],
  picture_motion: ["One cycle in slow motion", "Ein Zyklus in Zeitlupe"], play: ["Play", "Abspielen"], pause: ["Pause", "Anhalten"], slower: ["times slower", "mal langsamer"],
  normal_force: ["normal force", "Normalkraft"], friction_force: ["friction", "Reibkraft"], phase_angle: ["Place in the cycle", "Stelle im Zyklus"], in_weights: ["in weights", "in Gewichtskr\u00e4ften"],
  flight: ["thrown", "im Wurf"], no_motion: ["There is no periodic motion to show.", "Es gibt keine periodische Bewegung zu zeigen."],
  measured_title: ["Your measured points", "Ihre Messpunkte"],
  measured_help: ["Paste two or three columns from a spreadsheet: the input on the horizontal axis, the speed in the unit above ({0}), and its uncertainty if known. A header such as \u201cstroke_mm speed_m_per_min\u201d says otherwise.",
    "Zwei oder drei Spalten aus einer Tabelle einf\u00fcgen: die Eingabe der waagerechten Achse, die Geschwindigkeit in der Einheit oben ({0}) und, wenn bekannt, ihre Unsicherheit. Eine Kopfzeile wie \u201estroke_mm speed_m_per_min\u201c sagt es anders."],
  measured_count: ["{0} points are drawn.", "{0} Punkte sind gezeichnet."], measured_wrong: ["Line {0}: \u201c{1}\u201d is not two or three numbers; write for example 9.7  0.31.", "Zeile {0}: \u201e{1}\u201c sind nicht zwei oder drei Zahlen; zum Beispiel 9,7  0,31 schreiben."],
  measured_header: ["\u201c{0}\u201d is not a column that is known; write one of {1}.", "\u201e{0}\u201c ist keine bekannte Spalte; m\u00f6glich sind {1}."],
  measured_axis: ["Choose \u201c{0}\u201d across to see these points.", "W\u00e4hlen Sie waagerecht \u201e{0}\u201c, um diese Punkte zu sehen."],
  wrong_number: ["\u201c{0}\u201d is not a number; write for example {1}.", "\u201e{0}\u201c ist keine Zahl; zum Beispiel {1} schreiben."],
  wrong_range: ["{0} is outside {1} to {2}; write for example {3}.", "{0} liegt au\u00dferhalb von {1} bis {2}; zum Beispiel {3} schreiben."],
  compare: ["Compare with a second machine", "Mit einer zweiten Maschine vergleichen"], stop_compare: ["Remove machine B", "Maschine B entfernen"],
  edit: ["Inputs of", "Eingaben von"], difference: ["B against A", "B gegen A"], comparison: ["Two machines", "Zwei Maschinen"],
  copy_link: ["Copy link", "Link kopieren"], copy_campaign: ["Copy as campaign file", "Als Kampagnendatei kopieren"], print: ["Print", "Drucken"],
  copied_link: ["The link is copied; it holds all inputs.", "Der Link ist kopiert; er enth\u00e4lt alle Eingaben."],
  copied_campaign: ["The campaign file is copied: save it as machine.toml and run \u201cvibrotrough check machine.toml\u201d.", "Die Kampagnendatei ist kopiert: als machine.toml speichern und \u201evibrotrough check machine.toml\u201c aufrufen."],
  copy_failed: ["This browser does not allow copying; select the text below.", "Dieser Browser erlaubt das Kopieren nicht; bitte den Text unten markieren."],
  close: ["Close", "Schlie\u00dfen"],
  thin_layer: ["A layer thinner than one grain cannot be simulated.", "Eine Schicht d\u00fcnner als ein Korn kann nicht simuliert werden."],
  unit: ["Unit", "Einheit"], language_name: ["Language", "Sprache"],
  campaign_title: ["Simulated cases of {0}", "Simulierte F\u00e4lle von {0}"], campaign_case: ["case", "Fall"], use_case: ["Take its inputs", "Seine Eingaben nehmen"],
  rolling_note: ["Up to 0.03 the grains count as rolling, from 0.2 on as hardly rolling.", "Bis 0,03 gelten die K\u00f6rner als rollend, ab 0,2 als kaum rollend."],
  about: ["Computed in this page by the theory of Vibrotrough {0}: the point mass of Sloot and Kruyt (1996) and the law for rolling layers. Nothing is sent anywhere.",
    "In dieser Seite berechnet mit der Theorie von Vibrotrough {0}: Massenpunkt nach Sloot und Kruyt (1996) und das Gesetz der rollenden Schicht. Nichts wird versendet."],
  skip: ["To the answer", "Zur Antwort"], over_trough: ["relative to the trough", "relativ zur Rinne"],
  loading_failed: ["This browser cannot run WebAssembly: {0}", "Dieser Browser kann kein WebAssembly ausf\u00fchren: {0}"],
  no_answer: ["There is no answer: {0}", "Keine Antwort: {0}"],
};

/// The word of a key in the page's language, with {0}, {1} ... replaced.
function say(key, ...values) {
  const both = words[key];
  if (!both) return key;
  return both[page.language === "de" ? 1 : 0].replace(/\{(\d)\}/g, (_, i) => values[Number(i)]);
}

/// The sentences of the theory (tested_range.cpp, unusual.cpp, machine.cpp): what they match, and how the page says them.
const theorySentences = [
  [/^the rolling-layer law has not been tested at (.+?) = ([^ ,]+)(.*), outside (\[.*\])$/, (m) =>
    [`${nameOf(m[1])} ${short(m[2])}${placeOf(m[3])} is outside ${rangeOf(m[4])}, where the rolling-layer law was tested.`,
      `${nameOf(m[1])} ${short(m[2])}${placeOf(m[3])} liegt au\u00dferhalb von ${rangeOf(m[4])}, wo das Gesetz der rollenden Schicht gepr\u00fcft ist.`]],
  [/^the rolling-layer law has not been tested at throw_number = ([^ ,]+)(.*), where it has been for throw numbers in (\[.*\])$/, (m) =>
    [`${nameOf("throw_number")} ${short(m[1])}${placeOf(m[2])}: the rolling-layer law was tested at ${rangeOf(m[3])} there.`,
      `${nameOf("throw_number")} ${short(m[1])}${placeOf(m[2])}: das Gesetz der rollenden Schicht ist dort bei ${rangeOf(m[3])} gepr\u00fcft.`]],
  [/^the rolling-layer law has not been tested at throw_number = ([^ ,]+)(.*)$/, (m) =>
    [`The rolling-layer law was not tested at ${nameOf("throw_number")} ${short(m[1])}${placeOf(m[2])}.`,
      `Das Gesetz der rollenden Schicht ist bei ${nameOf("throw_number")} ${short(m[1])}${placeOf(m[2])} nicht gepr\u00fcft.`]],
  [/^the material runs away$/, () => ["The material runs away downhill.", "Das Gut rutscht ab."]],
  [/^no simulated layer tells what the model misses here$/, () =>
    ["No simulated layer tells how wrong the model is here.", "Keine simulierte Schicht sagt, wie falsch das Modell hier ist."]],
  [/^no layer was simulated with a rolling friction between/, () =>
    ["No layer was simulated with a rolling friction between 0.03 and 0.2: the band holds both models.", "Keine Schicht wurde mit einer Rollreibung zwischen 0,03 und 0,2 simuliert: das Band umfasst beide Modelle."]],
  [/^a frequency of (\S+) Hz is unusual.*were (\S+) turns/, (m) =>
    [`${short(m[1])} Hz is unusual: troughs run at 1 to 120 Hz. Were ${short(m[2])} turns per minute meant?`, `${short(m[1])} Hz sind ungew\u00f6hnlich: Rinnen laufen mit 1 bis 120 Hz. Waren ${short(m[2])} U/min gemeint?`]],
  [/^a frequency of (\S+) Hz is unusual.*were (\S+) Hz/, (m) =>
    [`${short(m[1])} Hz is unusual: troughs run at 1 to 120 Hz. Were ${short(m[2])} Hz meant, not rpm?`, `${short(m[1])} Hz sind ungew\u00f6hnlich: Rinnen laufen mit 1 bis 120 Hz. Waren ${short(m[2])} Hz gemeint, nicht U/min?`]],
  [/^an amplitude of (\S+) mm is unusual/, (m) =>
    [`An amplitude of ${short(m[1])} mm is unusual: strokes are mostly below 30 mm.`, `Eine Amplitude von ${short(m[1])} mm ist ungew\u00f6hnlich: Schwingbreiten sind meist unter 30 mm.`]],
  [/^a machine number of (\S+) is unusual/, (m) =>
    [`A machine number of ${short(m[1])} is unusual: troughs bear 3 to 6 times gravity. Was the stroke given as the amplitude, which is half of it?`, `Eine Maschinenkennziffer von ${short(m[1])} ist ungew\u00f6hnlich: Rinnen ertragen das 3- bis 6-Fache der Schwere. Wurde die Schwingbreite als Amplitude eingegeben, die halb so gro\u00df ist?`]],
  [/^a friction coefficient of (\S+) is unusual/, (m) =>
    [`A friction coefficient of ${short(m[1])} is unusual: it is mostly 0.1 to 1. Was an angle or a percentage meant?`, `Eine Reibungszahl von ${short(m[1])} ist ungew\u00f6hnlich: meist sind es 0,1 bis 1. War ein Winkel oder ein Prozentwert gemeint?`]],
];

const theoryNames = { throw_number: ["throw number", "Wurfkennziffer"], tan_vibration_angle: ["tan of the drive angle", "tan des Wurfwinkels"], friction: ["friction", "Reibungszahl"],
  tan_inclination: ["tan of the inclination", "tan der Neigung"], "a depth in diameters of the grains": ["depth in grains", "H\u00f6he in K\u00f6rnern"] };

function short(text) { return showNumber(Number(text)); }
function nameOf(name) { return (theoryNames[name] || [name, name])[page.language === "de" ? 1 : 0]; }
function rangeOf(text) { return text.slice(1, -1).split(",").map(short).join(` ${say("to")} `); }

/// What follows the number: ", tan_inclination = 0.05, a depth in diameters of the grains = 4".
function placeOf(text) {
  const parts = text.split(", ").filter((part) => part.includes(" = ")).map((part) => part.split(" = "));
  return parts.length === 0 ? "" : ` (${parts.map(([name, value]) => `${nameOf(name)} ${short(value)}`).join(", ")})`;
}

/// A sentence of the theory in the page's language; as it is when none matches.
function sayTheory(sentence) {
  for (const [pattern, both] of theorySentences) {
    const match = sentence.match(pattern);
    if (match) { const text = both(match)[page.language === "de" ? 1 : 0]; return text[0].toUpperCase() + text.slice(1); }
  }
  return sentence;
}
