// What the layer does, in words.

const degrees = 180 / Math.PI;

function phaseWords(phase, next) {
  const angle = Math.round((phase.end - phase.start) * degrees);
  if (phase.kind === "F") return `${say("is_thrown", angle)}, ${say("lands", landingWords(next))}`;
  if (phase.kind.startsWith("P")) return say("slides_f", angle);
  if (phase.kind.startsWith("N")) return say("slides_b", angle);
  return say("rests", angle);
}

function landingWords(next) {
  if (next.kind.startsWith("P")) return say("forwards");
  if (next.kind.startsWith("N")) return say("backwards");
  return say(next.kind === "F" ? "flying" : "resting");
}

/// "thrown for 210 degrees of the cycle, lands sliding forwards, slides backwards for 40°"
function motionSentence(motion) {
  if (motion.outcome.startsWith("it runs away") || /exceeds friction|runs away/.test(motion.outcome)) return say("runs_away");
  const { phases } = motion;
  if (phases.length === 0) return say("no_period");
  const seen = phases.filter((phase) => Math.round((phase.end - phase.start) * degrees) > 0);  // others would be told as 0 degrees
  const parts = seen.map((phase, i) => phaseWords(phase, seen[(i + 1) % seen.length]));
  const shown = parts.length > 6 ? [...parts.slice(0, 6), "\u2026"] : parts;
  if (motion.period_cycles > 1) shown.push(say("cycles", motion.period_cycles));
  const text = shown.join(", ");
  return `${text[0].toUpperCase()}${text.slice(1)}.`;
}
