// A robot at work: switches for what fails, what is said to it, and what it makes of them.

const PLACES = ["rests", "waits for the operator", ""];
const GLOBALS = [
  "waits for a mission", "", "is accomplished", "was ended: the robot stops",
  "was ended: it stands",
];
const DECISIONS = [
  "what runs goes on", "it goes on in another way", "the operator is asked", "the mission ends",
];
const PERIOD = 100;

/** The union of sets of bits, as halves of 32. */
function united(all) {
  return all.reduce((a, b) => [(a[0] | b[0]) >>> 0, (a[1] | b[1]) >>> 0], [0, 0]);
}

function bit(at) {
  return at < 32 ? [(1 << at) >>> 0, 0] : [0, (1 << (at - 32)) >>> 0];
}

function has(set, at) {
  const [low, high] = bit(at);
  return (set[0] & low) !== 0 || (set[1] & high) !== 0;
}

/**
 * Why flags are up, and what of the robot works: failures and flags that are switched on; in a
 * course also modules that do not work, what has failed unseen, and whether the robot still moves.
 */
class World {
  constructor(robot) {
    this.robot = robot;
    this.failures = new Set();
    this.flags = new Set();
    this.gone = new Set();
    this.unseen = new Set();
    this.moves = new Set();
  }

  set(word) {
    return {
      m: this.failures, f: this.flags, w: this.gone, b: this.unseen, v: this.moves,
    }[word[0]] || new Set();
  }

  /** Switches one thing: `m3` a failure, `f3` a flag, `w3` a module. */
  toggle(word) {
    const at = Number(word.slice(1));
    const set = this.set(word);
    if (!set.delete(at)) {
      set.add(at);
    }
  }

  is(word) {
    return this.set(word).has(Number(word.slice(1)));
  }

  /** The words that make a set hold these numbers. */
  changes(letter, numbers) {
    const set = this.set(letter);
    const all = [...set].filter((it) => !numbers.has(it));
    return [...all, ...[...numbers].filter((it) => !set.has(it))].map((it) => letter + it);
  }

  /** The flags that are up. */
  up() {
    const shown = [...this.failures].flatMap((it) => this.robot.failures[it].flags);
    return united([...shown, ...this.flags].map(bit));
  }

  /** The modules that say that they work. */
  works() {
    const gone = united([...this.gone].map(bit));
    return [...this.failures].map((it) => this.robot.failures[it].works)
      .reduce((a, b) => [(a[0] & b[0]) >>> 0, (a[1] & b[1]) >>> 0],
        [~gone[0] >>> 0, ~gone[1] >>> 0]);
  }
}

/** The engine with a decider beside the supervisors. */
class RobotEngine extends Engine {
  static async with(data) {
    const made = await WebAssembly.instantiate(bytesOf(data.module), {});
    const it = new RobotEngine(made.instance.exports, bytesOf(data.model), 0);
    it.tables = bytesOf(data.robot.tables);
    it.start(PERIOD);
    return it;
  }

  start(period) {
    super.start(period);
    if (!this.tables) {
      return;
    }
    const { exports, page, tables } = this;
    const at = exports.tables(page, tables.length);
    new Uint8Array(exports.memory.buffer, at, tables.length).set(tables);
    if (exports.employ(page) !== 0) {
      throw new Error(this.text());
    }
  }

  /** A period: returns what was found, told and done, or why not. `planned` is 0, or 1 more than
      the number of the row that the planner tells. */
  period(world, said, planned, stands, at) {
    const told = said === null ? 0 : said[1] * 256 + said[2] + 1;
    const more = [told, planned, stands ? 1 : 0];
    const bits = [...world.up(), ...world.works()];
    const status = this.exports.period(this.page, ...bits, ...more, ...halves(at));
    if (status !== 0) {
      return REFUSED[status];
    }
    const from = this.words();
    const account = { found: from.list(1), event: from.next() - 1 };
    const [kind, number] = [from.next(), from.next()];
    account.accepted = kind > 0 ? [kind - 1, number - 1] : null;
    account.restarts = [from.next(), from.next()];
    account.records = this.recordsOf(from);
    return account;
  }

  /** The place of the robot, and what is requested of it. */
  robot() {
    this.exports.pilot(this.page);
    const from = this.words();
    const place = [from.next(), from.next(), from.next()];
    const global = [from.next(), from.next()];
    const lost = from.next();
    const up = [from.next(), from.next()];
    const configuration = from.next() - 1;
    const [drive, speed] = [from.next() === 1, from.next()];
    const settings = [from.next(), from.next()];
    const [halt, ask, alarm] = [from.next() === 1, from.next() === 1, from.next() === 1];
    const [listens, agrees] = [from.next() === 1, from.next() === 1];
    return {
      place, global, lost, up, configuration, drive, speed, settings, halt, ask, alarm, listens,
      agrees,
    };
  }
}

/** The page of a robot: as any page, but each step is a period of its decider. */
class RobotPlay extends Play {
  begin(period) {
    super.begin(period);
    this.world = new World(this.data.robot);
    this.pending = [];
    this.plain = Boolean(this.plain);
    this.robot = this.engine.robot();
  }

  controls() {
    super.controls();
    const { robot } = this.data;
    byId("robot").hidden = false;
    byId("rounds").parentNode.hidden = true;
    byId("supervisors").open = false;
    this.says = new Map(robot.says.map((it) => [it[0], it]));
    this.switches = new Switches(robot, (word) => this.toggle(word));
    this.status = new Status(robot);
    byId("decider").addEventListener("click", () => {
      this.plain = false;
      this.restart(PERIOD);
      this.say("From the start, with the decider.");
    });
    this.answers = robot.says.filter((it) => ![4, 5].includes(it[1])).map((it) => {
      const own = button(it[3], () => this.tell(it[0]));
      byId("says").append(own);
      return [own, it[0]];
    });
  }

  /** Switches a failure or a flag; the robot sees it in the next period. */
  toggle(word) {
    this.world.toggle(word);
    this.pending.push(word);
    this.pass(this.when());
  }

  /** True if the decider takes this as said: a report is told by flags alone. */
  takes(event) {
    const said = this.says.get(event);
    return Boolean(said) && ![4, 5].includes(said[1]);
  }

  /** A run from a file, or one that tells reports, is played without the decider. */
  play(run) {
    const tells = (it) => it.event !== null && !this.takes(it.event);
    this.plain = run.fired !== undefined || run.steps.some(tells);
    return super.play(run);
  }

  step(event, at, why, toggles) {
    if (this.plain) {
      return super.step(event, at, why);
    }
    const said = event === null ? null : this.says.get(event);
    if (event !== null && !this.takes(event)) {
      this.say("A report is told by flags: switch on a failure, or a flag.");
      return false;
    }
    (toggles || []).forEach((word) => {
      this.world.toggle(word);
      this.pending.push(word);
    });
    const stands = !this.robot.drive && this.world.moves.size === 0;
    const tells = this.pending.find((word) => word[0] === "p");
    const planned = tells ? Number(tells.slice(1)) + 1 : 0;
    const when = Math.max(at, this.now());
    const done = this.engine.period(this.world, said, planned, stands, when);
    if (typeof done === "string") {
      this.say(done);
      return false;
    }
    this.run.steps.length = this.run.at;
    this.robot = this.engine.robot();
    this.run.steps.push({
      event: done.event >= 0 ? done.event : null,
      said: event,
      at: when,
      records: done.records,
      toggles: this.pending,
      account: done,
      why: "",
    });
    this.pending = [];
    this.run.at += 1;
    return true;
  }

  tell(event) {
    if (this.plain) {
      super.tell(event);
    } else if (this.step(event, this.when(), "")) {
      const step = this.run.steps[this.run.at - 1];
      this.show();
      const heard = step.event === event;
      const [own] = [this.says.get(event)];
      this.say(heard ? this.story(step) : `${own[3]}: not heard, a report goes first. ` +
        this.story(step));
    }
  }

  pass(at) {
    if (this.plain) {
      return super.pass(at);
    }
    const is = this.step(null, at, "");
    if (is) {
      this.show();
      this.say(this.story(this.run.steps[this.run.at - 1]));
    }
    return is;
  }

  /** Plays the periods of a course from the start; `failed` says which rows have failed when. */
  course(periods, failed) {
    this.plain = false;
    this.restart(PERIOD);
    const events = new Map(this.data.robot.says.map((it) => [it[1] * 256 + it[2], it[0]]));
    const members = (set, is) => new Set(Array.from({ length: 64 }, (_, at) => at)
      .filter((at) => has(set, at) === is));
    let before = "";
    periods.every((it) => {
      const look = `${it.up} ${it.works} ${it.coasts}`;
      const same = look === before;
      before = look;
      const toggles = [...it.planned, ...this.world.changes("b", failed(it.at))];
      if (!same) {
        toggles.push(...this.world.changes("f", members(it.up, true)),
          ...this.world.changes("w", members(it.works, false)),
          ...this.world.changes("v", new Set(it.coasts ? [0] : [])));
      }
      const event = it.said === null ? null : events.get(it.said);
      return this.step(event === undefined ? null : event, it.at, "", toggles);
    });
    this.show();
  }

  /** True if the operator drives. */
  operates() {
    const [kind, sub] = this.robot.place;
    return kind === 2 && this.data.robot.sub_objectives[sub][1];
  }

  /** Sentences on what came of a period. */
  story(step) {
    const { robot } = this.data;
    const parts = [];
    const switched = step.toggles.filter((word) => /^[mf]/.test(word)).map((word) => {
      const at = Number(word.slice(1));
      return word[0] === "m" ? robot.failures[at].id : `flag ${robot.flags[at][0]}`;
    });
    if (switched.length > 0) {
      parts.push(`switched: ${switched.join(", ")}`);
    }
    if (step.account.found.length > 0) {
      const found = step.account.found.map((it) => robot.failures[it]);
      const ids = found.map((it) => `${it.id} (${it.severity[this.operates() ? 1 : 0]})`);
      parts.push(`new flags are taken for ${ids.join(", ")}`);
    }
    if (step.event !== null) {
      const said = this.says.get(step.event);
      parts.push(`told: ${said ? said[3] : this.data.events[step.event][0]}`);
    }
    const restarted = robot.modules.filter((_, at) => has(step.account.restarts, at));
    if (restarted.length > 0) {
      parts.push(`started anew: ${restarted.join(", ")}`);
    }
    const [first, classes] = robot.decisions || [0, ""];
    const decided = step.records.flatMap((it) => it.fired).map((it) => classes[it - first]);
    decided.filter((it) => it !== undefined).forEach((it) => {
      parts.push(`decided: ${DECISIONS[Number(it)]}`);
    });
    parts.push(this.log.said({ ...step, why: "" }));
    return `${seconds(step.at)}: ${parts.join("; ")}.`;
  }

  go(to) {
    super.go(to);
    if (this.plain) {
      return;
    }
    const world = new World(this.data.robot);
    this.run.steps.slice(0, this.run.at).forEach((it) => it.toggles.forEach((word) => {
      world.toggle(word);
    }));
    this.world = world;
    this.pending = [];
    this.robot = this.engine.robot();
    this.situation();
  }

  linked() {
    const steps = super.linked();
    return this.plain ? steps : steps.map((it) => ({ ...it, event: it.said }));
  }

  show() {
    super.show();
    this.situation();
  }

  situation() {
    byId("robot").hidden = this.plain;
    byId("decider").hidden = !this.plain;
    if (this.plain) {
      byId("supervisors").open = true;
      return;
    }
    this.status.show(this.robot, this.world);
    this.switches.show(this.world);
    const { prospects } = this.state;
    this.answers.forEach(([own, event]) => {
      own.hidden = prospects[event][0] !== 0;
    });
    if (!this.robot.agrees) {
      broken(new Error("the decider and the drawing are not where each other is"));
    }
  }
}
