// The theory, compiled from the sources of the program. All names of numbers come from it (theory_page.cpp).

class Theory {
  /// @param module  what makeTheory() gave
  constructor(module) {
    this.module = module;
    this.names = JSON.parse(this.text(module._page_names()));
    this.input = module._malloc(8 * this.names.settings.length);
    this.capacity = 4096;
    this.output = module._malloc(8 * this.capacity);
    this.modeNames = new Map([[0, ""]]);
  }

  text(pointer) { return this.module.UTF8ToString(pointer); }

  give(settings) {
    this.module.HEAPF64.set(this.names.settings.map((name) => settings[name]), this.input / 8);
  }

  /// @throws Error with the sentence of the theory
  numbers(size, status) {
    if (status !== 0) throw new Error(this.text(this.module._page_error()));
    return this.module.HEAPF64.slice(this.output / 8, this.output / 8 + size);
  }

  mode(number) {
    if (!this.modeNames.has(number)) this.modeNames.set(number, this.text(this.module._page_mode(number)));
    return this.modeNames.get(number);
  }

  named(numbers, offset = 0) {
    const answer = {};
    this.names.answer.forEach((name, i) => { answer[name] = numbers[offset + i]; });
    for (const of of ["mass", "layer", "atlas", "best"]) answer[`${of}_mode`] = this.mode(answer[`${of}_mode`]);
    return answer;
  }

  prepareAtlas() { this.module._page_prepare_atlas(); }

  answer(settings) {
    this.give(settings);
    const status = this.module._page_answer(this.input, this.output);
    return this.named(this.numbers(this.names.answer.length, status));
  }

  /// The answers at one value of a setting, or null where there is none.
  answerAt(settings, name, value) {
    try {
      return this.answer({ ...settings, [name]: value });
    } catch (error) {
      return null;
    }
  }

  /// Efficiency, speed and mode along one setting; the mode is "violent" where no trough bears the acceleration.
  mapRow(settings, axis, from, to, count, rolling) {
    this.give(settings);
    const number = this.names.settings.indexOf(axis);
    const status = this.module._page_map_row(this.input, number, from, to, count, rolling ? 1 : 0, this.output);
    const numbers = this.numbers(4 * count, status), most = this.names.largest_usual_machine_number;
    return Array.from({ length: count }, (_, i) => {
      const [efficiency, speed, mode, machineNumber] = numbers.subarray(4 * i, 4 * i + 4);
      return { efficiency, speed, mode: machineNumber > most ? "violent" : this.mode(mode) };
    });
  }

  /// The motion over a period; null when there is none.
  frames(settings, rolling, count) {
    this.give(settings);
    try {
      const width = this.names.frame.length;
      const numbers = this.numbers(width * count, this.module._page_frames(this.input, rolling ? 1 : 0, count, this.output));
      return Array.from({ length: count }, (_, i) =>
        Object.fromEntries(this.names.frame.map((name, k) => [name, numbers[width * i + k]])));
    } catch (error) {
      return null;
    }
  }

  /// Phases, landing, and what is not tested or unusual.
  words(settings) {
    this.give(settings);
    const text = this.text(this.module._page_words(this.input));
    if (text === "") throw new Error(this.text(this.module._page_error()));
    return JSON.parse(text);
  }
}

/// Ready when the WebAssembly within this file is unpacked and compiled, which happens beside the rest of the page.
async function openTheory() {
  const packed = atob(document.getElementById("theory").textContent.trim());
  // A loop: Uint8Array.from() takes ten times as long.
  const bytes = new Uint8Array(packed.length);
  for (let i = 0; i < packed.length; ++i) bytes[i] = packed.charCodeAt(i);
  const unpacked = new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream("gzip")), { headers: { "Content-Type": "application/wasm" } });
  return new Promise((resolve, reject) => {
    const instantiateWasm = (imports, done) => {
      WebAssembly.instantiateStreaming(unpacked, imports).then(({ instance, module }) => done(instance, module)).catch(reject);
      return {};
    };
    makeTheory({ instantiateWasm }).then((module) => resolve(new Theory(module)), reject);
  });
}
