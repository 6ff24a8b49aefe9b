// A mission under a plan of faults: what comes of it while its faults are moved along the time.

const NEVER = { began: null, found: null, over: null };
/** The most rows of what came of it. */
const MOST_CAME = 200;

/** The engine runs a course: from the start to its end, beside the run that is played. */
class Courses {
  /** A page of the module of its own: the run that is played begins anew in its own one. */
  constructor(engine, world) {
    const own = new RobotEngine(engine.exports, engine.model, 0);
    own.tables = engine.tables;
    own.start(PERIOD);
    const { exports, page } = own;
    const bytes = bytesOf(world);
    const at = exports.tables(page, bytes.length);
    new Uint8Array(exports.memory.buffer, at, bytes.length).set(bytes);
    if (exports.world(page) !== 0) {
      throw new Error(own.text());
    }
    this.engine = own;
  }

  run(numbers) {
    const { engine } = this;
    const { exports, page } = engine;
    const at = exports.plan(page, numbers.length);
    new Uint32Array(exports.memory.buffer, at, numbers.length).set(numbers);
    if (exports.course(page) !== 0) {
      throw new Error("the plan cannot be run");
    }
    const from = engine.words();
    const when = (it) => (it === 0 ? null : it - 1);
    const course = { ended: from.next(), end: from.next() };
    course.fates = from.list(3).map(([began, found, over]) => ({
      began: when(began), found: when(found), over: when(over),
    }));
    course.marks = from.list(3);
    course.samples = from.list(3);
    return course;
  }

  /** The periods of the last course. */
  periods() {
    this.engine.exports.periods(this.engine.page);
    return this.engine.words().list(8).map(([at, a, b, c, d, said, planned, coasts]) => ({
      at,
      up: [a, b],
      works: [c, d],
      said: said === 0 ? null : said - 1,
      planned: planned === 0 ? [] : [`p${planned - 1}`],
      coasts: coasts === 1,
    }));
  }
}

/** The plan of faults: items that are moved, and written as a file. */
class PlanOfFaults {
  constructor(data) {
    this.data = data;
    this.fresh();
  }

  fresh() {
    this.items = this.data.outing.items.map((it) => ({ ...it }));
    this.is_changed = false;
  }

  move(at, time) {
    const it = this.items[at];
    const by = it.when[0] === 1 ? time - it.when[2] : 0;
    it.when = [1, 0, time];
    if (it.until && it.until[0] === 1) {
      const until = Math.max(it.until[2] + by, time);
      it.until = [1, 0, until];
      it.text = it.text.replace(/^until_t_ms = \d+$/m, `until_t_ms = ${until}`);
    }
    this.is_changed = true;
  }

  add(row, time) {
    const { id } = this.data.robot.failures[row];
    const text = `kind = "failure"\nmode = ${JSON.stringify(id)}`;
    this.items.push({
      kind: "failure", row, when: [1, 0, time], until: null, answers: null, text, fixed: false,
    });
    this.is_changed = true;
  }

  remove(at) {
    this.items.splice(at, 1);
    this.is_changed = true;
  }

  /** The items in the order in which a file is read. */
  sorted() {
    const order = (a, b) => a.when[0] - b.when[0] || a.when[1] - b.when[1] || a.when[2] - b.when[2];
    return [...this.items].sort(order);
  }

  /** The plan as the engine takes it, and its faults in that order. */
  numbers() {
    const faults = [];
    const answers = [];
    this.sorted().forEach((it) => {
      if (it.kind === "failure") {
        faults.push({ item: it, until: it.until });
      } else if (it.kind === "repair") {
        const open = [...faults].reverse().find((of) => of.item.row === it.row && !of.until);
        if (open) {
          open.until = it.when;
        }
      } else {
        answers.push([it.when[1], it.answers[0], it.answers[1].length, ...it.answers[1]]);
      }
    });
    const said = faults.flatMap(({ item, until }) => [
      item.row, item.fixed ? 1 : 0, ...item.when, ...(until || [4, 0, 0]),
    ]);
    const all = [faults.length, ...said, answers.length, ...answers.flat()];
    return { all, faults: faults.map((it) => it.item) };
  }

  moment([kind, number, time]) {
    const parts = this.data.robot.sub_objectives;
    return [
      `x_mm = ${number}`, `t_ms = ${time}`,
      `during = ${JSON.stringify(parts[number] ? parts[number][0] : "")}\nafter_ms = ${time}`,
      `during = "Waits"\nafter_ms = ${time}`,
    ][kind];
  }

  /** A file of faults. */
  toml() {
    const [before, ...random] = this.data.outing.rest.split("\n[[random]]");
    const own = this.sorted().filter((it) => !it.fixed);
    const events = own.map((it) => `\n[[event]]\n${this.moment(it.when)}\n${it.text}\n`);
    const said = this.is_changed ? "# Changed in a page of `cotama play`.\n" : "";
    return said + before + events.join("") + random.map((it) => `\n[[random]]${it}`).join("");
  }
}

/** The panel of faults in time. */
class Outing {
  constructor(play) {
    this.play = play;
    this.data = play.data;
    this.plan = new PlanOfFaults(this.data);
    this.courses = new Courses(play.engine, this.data.outing.world);
    this.axis = new Axis(byId("axis"), (at, time) => this.move(at, time));
    this.time = 0;
    byId("course").hidden = false;
    byId("from").textContent = visible(`From ${this.data.outing.from}.`);
    this.controls();
    this.build();
    const first = Math.min(...this.course.fates.map((it) => it.began).filter((it) => it !== null));
    this.to(Number.isFinite(first) ? first : 0);
  }

  controls() {
    const { robot, outing } = this.data;
    byId("more").append(...robot.failures.map((it, at) => {
      return new Option(visible(`${it.id} ${it.what}`), String(at));
    }));
    byId("add").addEventListener("click", () => {
      this.plan.add(Number(byId("more").value), inRounds100(this.time));
      this.build();
    });
    byId("fresh").addEventListener("click", () => {
      this.plan.fresh();
      this.build();
    });
    byId("upto").addEventListener("click", () => this.upTo(this.time));
    byId("moment").addEventListener("input", (it) => this.to(Number(it.target.value)));
    byId("takeplan").addEventListener("click", () => {
      const copied = navigator.clipboard
        ? navigator.clipboard.writeText(this.plan.toml())
        : Promise.reject(new Error("no clipboard"));
      const said = (text) => () => this.play.say(text);
      copied.then(said("The plan is copied."), said("Not copied: the plan stands below."));
    });
    byId("saveplan").addEventListener("click", () => save("faults.toml", this.plan.toml()));
    byId("plancommand").textContent = visible(`${outing.command} faults.toml`);
    if (outing.unshown.length > 0) {
      byId("unshown").textContent = visible(`No flag shows, and no course here has: ${
        outing.unshown.join("; ")}. The plan as a file keeps that.`);
    }
    this.slider = document.querySelector("#plane .player input");
    if (this.slider) {
      this.slider.addEventListener("input", (it) => {
        if (!this.follows) {
          this.to(Number(it.target.value), true);
        }
      });
    }
  }

  /** Names of items, for the axis. */
  names() {
    const { failures, sub_objectives } = this.data.robot;
    return this.plan.items.map((it) => {
      const row = failures[it.row];
      if (it.kind === "operator") {
        const said = it.answers[1].map((n) => ["done", "give up"][n] || sub_objectives[n - 2][0]);
        const name = `the operator answers ${said.join(", ")}`;
        return { name, note: "to the first request from there on", fixed: true, timeless: true };
      }
      const name = it.kind === "repair" ? `${row.id} works again` : `${row.id} ${row.what}`;
      const unseen = row.flags.length === 0 || row.unseen
        ? `no flag shows it${row.unseen ? `: ${row.unseen}` : ""}` : "";
      const note = it.fixed ? "told by the planner in the run; stays there" : unseen;
      return { name, note: it.kind === "repair" ? "" : note, fixed: it.fixed };
    });
  }

  build() {
    this.axis.build(this.names());
    this.axis.rows.forEach((row, at) => {
      const it = this.plan.items[at];
      if (it.kind === "failure") {
        const off = button("✕", () => {
          this.plan.remove(at);
          this.build();
        });
        off.className = "off";
        off.setAttribute("aria-label", visible(`leave ${row.name} out`));
        row.whole.firstChild.append(off);
      }
    });
    this.refresh();
  }

  move(at, time) {
    this.plan.move(at, time);
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => this.refresh());
    this.to(time);
  }

  /** Runs the plan, and shows what comes of it. */
  refresh() {
    const { all, faults } = this.plan.numbers();
    this.course = this.courses.run(all);
    const fates = new Map(faults.map((it, at) => [it, this.course.fates[at]]));
    const items = this.plan.items.map((it) => this.shown(it, fates.get(it) || NEVER));
    this.course.runs = this.runs();
    this.axis.show(items, this.course, this.data.outing.limit_ms);
    byId("ends").textContent = this.ends();
    byId("plan").textContent = visible(this.plan.toml()).replace(/\\u\{a\}/g, "\n");
    byId("fresh").disabled = !this.plan.is_changed;
    byId("moment").max = String(this.course.end);
    this.list();
    this.onFloor();
    this.to(this.time);
  }

  ends() {
    const last = this.course.samples[this.course.samples.length - 1];
    const words = ["It is not over after an hour", "The mission is accomplished",
      "The robot stands safely"][this.course.ended];
    const where = this.data.outing.length_mm > 0 ? `, ${(last[1] / 1000).toFixed(1)} m` : "";
    const limit = this.data.outing.limit_ms;
    const late = limit > 0 && this.course.end > limit
      ? `: later than its limit of ${seconds(limit)}` : "";
    return `${words} after ${seconds(this.course.end)}${where}${late}.`;
  }

  shown(it, fate) {
    const at = it.when[0] === 1 ? it.when[2] : null;
    const time = fate.began === null ? (at === null ? this.course.end : at) : fate.began;
    const where = [`at ${(it.when[1] / 1000).toFixed(1)} m`, "", "in its sub-objective",
      "while it waits"][it.when[0]];
    if (it.kind !== "failure") {
      return { time: at === null ? 0 : at, fate, words: at === null ? where : seconds(at) };
    }
    const parts = fate.began === null
      ? [`${where || seconds(time)}: not come to`]
      : [`${seconds(fate.began)}${where ? ` (${where})` : ""}`,
        fate.found === null ? "its flags do not rise" : `flags ${seconds(fate.found)}`,
        ...(fate.over === null ? [] : [`over ${seconds(fate.over)}`])];
    return { time, fate, words: parts.join(", ") };
  }

  /** Configurations of the robot, one after the other. */
  runs() {
    const { configurations, sub_objectives } = this.data.robot;
    const places = this.course.marks.filter((it) => it[1] === 0);
    const runs = places.map(([from, , place], at) => {
      const to = at + 1 < places.length ? places[at + 1][0] : this.course.end;
      const runs = configurations[place - 2];
      if (!runs) {
        return { from, to, kind: ["none", "asks"][place], name: "waits" };
      }
      return { from, to, kind: sub_objectives[runs.sub_objective][1] ? "his" : "own", name: runs.name };
    });
    return runs.filter((it) => it.kind !== "none");
  }

  /** Words for a mark. */
  word([, kind, number]) {
    const { failures, says, configurations } = this.data.robot;
    if (kind === 0) {
      return ["the robot rests", "the robot waits for the operator"][number]
        || `${configurations[number - 2].name} runs`;
    }
    if (kind === 1) {
      return `new flags are taken for ${failures[number].id}`;
    }
    if (kind === 2) {
      const said = says.find((it) => it[1] * 256 + it[2] === number);
      return said ? `told: ${said[3]}` : "told something";
    }
    const [first, classes] = this.data.robot.decisions || [0, ""];
    const decided = classes[number - first];
    return decided === undefined ? null : `decided: ${DECISIONS[Number(decided)]}`;
  }

  list() {
    const at = new Map();
    this.course.marks.forEach((it) => {
      const word = this.word(it);
      if (word !== null) {
        at.set(it[0], [...(at.get(it[0]) || []), word]);
      }
    });
    this.came = [...at].slice(0, MOST_CAME).map(([time, words]) => {
      const row = made("li", "", made("span", "at", seconds(time)), ` ${words.join("; ")}`);
      row.addEventListener("click", () => this.to(time));
      return { time, row };
    });
    byId("came").replaceChildren(...this.came.map((it) => it.row));
  }

  /** Goes to a moment of the course. */
  to(time, from_floor) {
    this.time = Math.min(Math.max(time, 0), this.course.end);
    byId("moment").value = String(this.time);
    byId("momentis").textContent = seconds(inRounds100(this.time));
    this.axis.point(this.time);
    let last = null;
    this.came.forEach((it) => {
      it.row.classList.remove("now");
      it.row.classList.toggle("later", it.time > this.time);
      last = it.time <= this.time ? it : last;
    });
    if (last) {
      last.row.classList.add("now");
      const frame = byId("came");
      frame.scrollTop = last.row.offsetTop - frame.offsetTop - frame.clientHeight / 2;
    }
    if (this.slider && !from_floor) {
      this.follows = true;
      this.slider.value = String(this.time);
      this.slider.dispatchEvent(new Event("input"));
      this.follows = false;
    }
  }

  /** Lets the robot on the floor go as in the course, once that is another one than the run. */
  onFloor() {
    if (!this.slider || !window.RUN) {
      return;
    }
    this.recorded = this.recorded || { ...window.RUN, end: this.slider.max };
    const { plan, recorded, course } = this;
    const own = plan.is_changed;
    const runs = course.runs.map((it) => [it.from, it.name]);
    Object.assign(window.RUN, own
      ? { samples: course.samples, poses: [], rays: [], runs }
      : { samples: recorded.samples, poses: recorded.poses, rays: recorded.rays,
        runs: recorded.runs });
    this.slider.max = own ? String(course.end) : recorded.end;
    byId("plane").classList.toggle("changed", own);
  }

  /** Plays the course up to a time in the page: its periods become the run. */
  upTo(time) {
    const began = this.courses.periods();
    this.play.course(began.filter((it) => it.at <= time), (at) => this.failed(at));
    this.play.say(`The run of the course up to ${seconds(inRounds100(time))}: ${
      this.play.run.steps.length} periods. Play on from here.`);
  }

  /** The rows that have failed at a time, by number. */
  failed(at) {
    const { faults } = this.plan.numbers();
    const open = faults.filter((_, fault) => {
      const fate = this.course.fates[fault];
      return fate.began !== null && fate.began <= at && (fate.over === null || at < fate.over);
    });
    return new Set(open.map((it) => it.row));
  }
}
