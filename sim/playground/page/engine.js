// The module: the player compiled to WebAssembly, behind functions that speak of lists.

/** Bytes of base 64. */
function bytesOf(letters) {
  return Uint8Array.from(atob(letters), (it) => it.charCodeAt(0));
}

/** A list of numbers, read one after the other. */
class Numbers {
  constructor(words) {
    this.words = words;
    this.at = 0;
  }

  next() {
    this.at += 1;
    return this.words[this.at - 1];
  }

  time() {
    const low = this.next();
    return low + this.next() * 4294967296;
  }

  /** A list after its length; an item of several numbers is a list itself. */
  list(size) {
    const items = [];
    for (let left = this.next(); left > 0; left -= 1) {
      items.push(size === 1 ? this.next() : Array.from({ length: size }, () => this.next()));
    }
    return items;
  }
}

const REFUSED = [
  "",
  "not done: it would not come to rest",
  "not done: the run is as long as a page can hold",
  "not done: there is no such event, or the time would go back",
];

/** A model in play. Events, transitions and places are numbers; times are milliseconds. */
class Engine {
  /** Compiles the module, and loads the model; `period` is that of rounds, 0 for none. */
  static async of(module, model, period) {
    const made = await WebAssembly.instantiate(bytesOf(module), {});
    return new Engine(made.instance.exports, bytesOf(model), period);
  }

  constructor(exports, model, period) {
    this.exports = exports;
    this.model = model;
    this.start(period);
  }

  /** Begins anew, in rounds of this period or without. */
  start(period) {
    const { exports, model } = this;
    this.page = exports.open(model.length);
    new Uint8Array(exports.memory.buffer, exports.input(this.page), model.length).set(model);
    if (exports.load(this.page, period > 0 ? 1 : 0) !== 0) {
      throw new Error(this.text());
    }
    this.started = this.records();
  }

  words() {
    const { exports, page } = this;
    const length = exports.words_length(page);
    return new Numbers(new Uint32Array(exports.memory.buffer, exports.words(page), length));
  }

  text() {
    const { exports, page } = this;
    const length = exports.text_length(page);
    const bytes = new Uint8Array(exports.memory.buffer, exports.text(page), length);
    return new TextDecoder().decode(bytes);
  }

  records() {
    return this.recordsOf(this.words());
  }

  recordsOf(from) {
    const all = [];
    for (let left = from.next(); left > 0; left -= 1) {
      all.push({
        at: from.time(),
        round: from.next() === 1,
        events: from.list(1),
        fired: from.list(1),
        unused: from.list(2),
        emitted: from.list(1),
        changed: from.list(2),
      });
    }
    return all;
  }

  /** Lets time pass, then offers an event, or none for null; returns records, or why not. */
  tell(event, at) {
    const [low, high] = halves(at);
    const status = this.exports.tell(this.page, event === null ? 0 : event + 1, low, high);
    return status === 0 ? this.records() : REFUSED[status];
  }

  go(to) {
    this.exports.go(this.page, to);
  }

  /** The state, and what would use an event that is told at this time. */
  state(at) {
    this.exports.state(this.page, ...halves(at));
    const from = this.words();
    const state = {
      at: from.next(),
      steps: from.next(),
      now: from.time(),
      waits: from.next() === 1,
    };
    const is = from.next() === 1;
    const next = { at: from.time(), transition: from.next() };
    state.next = is ? next : null;
    state.tokens = from.list(1);
    state.prospects = from.list(2);
    return state;
  }

  /** Why no transition would use an event at this time. */
  why(event, at) {
    this.exports.why(this.page, event, ...halves(at));
    return this.text();
  }
}

function halves(time) {
  return [time % 4294967296, Math.floor(time / 4294967296)];
}
