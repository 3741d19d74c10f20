// What happens when: inputs change, frames are drawn, buttons are pressed.

const work = { dirty: true, asleep: true };

/// Something changed: the next frame shows it.
function changed() {
  work.dirty = true;
  keepLink();
  wake();
}

function wake() {
  if (!work.asleep) return;
  work.asleep = false;
  motion.last = performance.now();
  requestAnimationFrame(drawFrame);
}

/// One frame: the answer at once, then as much of curves and map as fits into the frame.
function drawFrame(now) {
  const began = performance.now(), until = began + 7;
  const wasDirty = work.dirty;
  if (work.dirty) { work.dirty = false; showAnswers(); }
  const curvesDone = growCurves(until);
  if (wasDirty || !work.curvesDone) { drawCurves(); showGap(); showCurveLegend(); }
  work.curvesDone = curvesDone;
  if (wasDirty) { drawMotion(); drawMapFrame(); }
  const mapDone = curvesDone && isSeen("map") ? growMap(until) : !isSeen("map") || !curvesDone ? false : true;
  if (stepMotion(now) && !wasDirty) drawMotion();
  Object.assign(document.documentElement.dataset, { drawn: Number(document.documentElement.dataset.drawn || 0) + 1, worked: performance.now() - began });
  document.documentElement.dataset.complete = String(curvesDone && (mapDone || !isSeen("map")));
  if (work.dirty || !curvesDone || (!mapDone && isSeen("map")) || motion.playing) requestAnimationFrame(drawFrame);
  else work.asleep = true;
}

/// On paper all pictures are complete, also those that nobody has scrolled to.
function completePictures() {
  if (!page.theory) return;
  growCurves(Infinity);
  growMap(Infinity);
  drawCurves();
  drawMap();
  drawMotion();
}

/// The map's points move at once, its colours follow.
function drawMapFrame() { if (isSeen("map") && map.rows.length > 0) drawMap(); }

function showAnswers() {
  page.answers = page.machines.map((one) => { try { return answerOf(one); } catch (error) { page.problem = error.message; return null; } });
  const answer = page.answers[page.active];
  if (answer) showAnswer(answer);
  else showNoAnswer(page.problem);
  showComparison();
  showDesignNow();
  if (!document.documentElement.dataset.answered) document.documentElement.dataset.answered = performance.now();
}

/// Words, lists of choices and everything that holds words.
function translate() {
  document.documentElement.lang = page.language;
  document.title = `${say("title")} \u00b7 Vibrotrough`;
  for (const element of document.querySelectorAll("[data-word]")) element.textContent = say(element.dataset.word);
  for (const element of document.querySelectorAll("[data-unit]")) element.textContent = unitOf(settingNamed[element.dataset.unit]);
  for (const button of document.querySelectorAll("[data-poles]")) button.textContent = say("poles", ...button.dataset.poles.split(","));
  put("about", say("about", JSON.parse(document.getElementById("program").textContent).version));
  fillChoices();
  fillFields();
  showMeasuredNote();
  showMotionLegend();
  showCases();
  showDesigns();
  showMachines();
}

function fillChoices() {
  for (const [id, choice, names] of [["curve-axis", "curveAxis", axisNames], ["map-x", "mapX", mapAxisNames], ["map-y", "mapY", mapAxisNames]]) {
    const select = document.getElementById(id);
    select.replaceChildren(...names.map((name) => make("option", { value: name }, say(name))));
    select.value = page[choice];
  }
  for (const [id, choice] of [["curve-quantity", "curveQuantity"], ["map-model", "mapModel"], ["motion-model", "motionModel"], ["unit", "speedUnit"], ["language", "language"]])
    document.getElementById(id).value = page[choice];
}

function showMachines() {
  const two = page.machines.length > 1;
  document.querySelector("#machines .tabs").hidden = !two;
  put("compare", say(two ? "stop_compare" : "compare"));
  document.getElementById("edit-a").setAttribute("aria-pressed", String(page.active === 0));
  document.getElementById("edit-b").setAttribute("aria-pressed", String(page.active === 1));
  document.body.dataset.active = page.active;
}

function edit(index) {
  settings.forEach(({ name }) => clearWrong(name));
  clearWrong("amplitude_mm");
  page.active = index;
  showMachines();
  fillFields();
  changed();
}

function toggleCompare() {
  if (page.machines.length > 1) { page.machines.pop(); curves[1] = null; edit(0); }
  else { page.machines.push({ ...page.machines[0] }); edit(1); }
}

/// A choice in a list: what it changes, and what else has to follow.
function listenToChoice(id, choice, after = () => {}) {
  document.getElementById(id).addEventListener("change", (event) => { page[choice] = event.target.value; after(); changed(); });
}

function otherAxis(kept, other) {
  if (page[kept] === page[other]) page[other] = mapAxisNames.find((name) => name !== page[kept]);
  fillChoices();
}

function listen() {
  const on = (id, event, action) => document.getElementById(id).addEventListener(event, action);
  listenToChoice("language", "language", translate);
  listenToChoice("unit", "speedUnit", () => { showMeasuredNote(); showCases(); });
  listenToChoice("curve-axis", "curveAxis", showMeasuredNote);
  listenToChoice("curve-quantity", "curveQuantity", showMeasuredNote);
  listenToChoice("map-x", "mapX", () => otherAxis("mapX", "mapY"));
  listenToChoice("map-y", "mapY", () => otherAxis("mapY", "mapX"));
  listenToChoice("map-model", "mapModel");
  listenToChoice("motion-model", "motionModel");
  on("inputs", "submit", (event) => event.preventDefault());
  on("compare", "click", toggleCompare);
  on("edit-a", "click", () => edit(0));
  on("edit-b", "click", () => edit(1));
  on("measured", "input", takeMeasured);
  on("map", "click", clickMap);
  on("play", "click", () => setPlaying(!motion.playing));
  on("phase", "input", (event) => { motion.degrees = Number(event.target.value); setPlaying(false); drawMotion(); });
  on("print", "click", () => window.print());
  on("copy-link", "click", () => copyText(`${location.href.split("#")[0]}#${linkPart()}`, say("copied_link")));
  on("copy-campaign", "click", () => copyText(campaignFile(machine()),
    machine().depth_mm < machine().grain_mm ? say("thin_layer") : say("copied_campaign")));
  on("copied-close", "click", () => { document.getElementById("copied").hidden = true; showMessage(""); });
  window.addEventListener("beforeprint", completePictures);
  window.addEventListener("resize", changed);
  window.addEventListener("scroll", wake, { passive: true });
  // The link that is kept may have taken the place of this one meanwhile.
  window.addEventListener("hashchange", (event) => { readLink(new URL(event.newURL).hash); showMachines(); translate(); changed(); });
  window.matchMedia("(prefers-color-scheme: dark)").addEventListener("change", changed);
}

async function start() {
  const theory = openTheory();
  page.language = (navigator.language || "en").startsWith("de") ? "de" : "en";
  try {
    readDesigns(location.hash === "");
    readLink(location.hash);
    makeInputs();
    readCases();
    listen();
    translate();
    page.theory = await theory;
  } catch (error) {
    showNoAnswer(say("loading_failed", error.message));
    return;
  } finally {
    // Hidden until now: a page without its numbers would be laid out for nothing.
    document.querySelector("main").hidden = false;
  }
  motion.playing = !window.matchMedia("(prefers-reduced-motion: reduce)").matches;
  showMotionLegend();
  changed();
  requestAnimationFrame(() => setTimeout(prepareAtlas));
}

/// The first answer does not wait for the atlas.
function prepareAtlas() {
  page.theory.prepareAtlas();
  document.documentElement.dataset.atlas = performance.now();
  curves.fill(null);
  changed();
}

start();
