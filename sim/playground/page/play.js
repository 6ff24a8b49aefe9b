// The page: what is done with it, and what it shows.

/** The longest wait for the link to follow the run, in milliseconds: browsers limit how often. */
const LINK_AFTER = 600;
/** Between two steps while time runs. */
const TICK = 100;

class Play {
  constructor(data, engine, period) {
    this.data = data;
    this.engine = engine;
    this.begin(period);
    this.drawings = new Drawings(data, (transitions) => this.choose(transitions));
    this.events = new Events(data, (event) => this.tell(event));
    this.marking = new Marking(data);
    this.log = new Log(data, (at) => this.go(at));
    this.verdicts = new Verdicts(data);
    this.controls();
  }

  begin(period) {
    this.run = { at: 0, steps: [], started: this.engine.started, period };
    this.state = this.engine.state(period);
    this.frame = 0;
  }

  controls() {
    const on = (id, then) => byId(id).addEventListener("click", then);
    on("start", () => this.go(0));
    on("back", () => this.go(this.run.at - 1));
    on("forth", () => this.go(this.run.at + 1));
    on("end", () => this.go(this.run.steps.length));
    byId("where").addEventListener("input", (it) => this.go(Number(it.target.value)));
    on("next", () => this.state.next && this.pass(this.state.next.at));
    on("tenth", () => this.pass(this.state.now + 100));
    on("second", () => this.pass(this.state.now + 1000));
    on("round", () => this.pass(this.when()));
    on("runs", () => this.runs(!this.timer));
    on("all", () => this.events.look(null));
    on("copy", () => this.copy());
    on("record", () => {
      save(`${this.data.name}.jsonl`, recordingOf(this.data, this.run, this.state.now));
    });
    byId("rounds").checked = this.run.period > 0;
    byId("rounds").addEventListener("change", (it) => {
      this.restart(it.target.checked ? 100 : 0);
      this.say(it.target.checked
        ? "From the start, in rounds of 100 ms: mail waits for the next one."
        : "From the start: mail is read as soon as it waits.");
    });
    byId("rounds").parentNode.hidden = !this.data.system;
    byId("file").addEventListener("change", (it) => this.file(it.target.files[0]));
    byId("found").addEventListener("change", (it) => {
      this.play(this.found[Number(it.target.value)]);
    });
    document.addEventListener("keydown", (it) => {
      const elsewhere = /INPUT|SELECT|TEXTAREA/.test(it.target.tagName);
      if (it.altKey || it.ctrlKey || it.metaKey || elsewhere || it.defaultPrevented) {
        return;
      }
      if (it.key === "ArrowLeft") {
        this.go(this.run.at - 1);
      } else if (it.key === "ArrowRight") {
        this.go(this.run.at + 1);
      }
    });
    window.addEventListener("hashchange", () => {
      if (location.hash.slice(1) !== this.address) {
        this.attempt(() => this.follow());
      }
    });
  }

  /** The time of the last step. */
  now() {
    return this.run.at > 0 ? this.run.steps[this.run.at - 1].at : 0;
  }

  /** When the next event is told: in the next round, or now. */
  when() {
    return this.now() + this.run.period;
  }

  /** Takes a step; says why not. */
  step(event, at, why) {
    const done = this.engine.tell(event, at);
    if (typeof done === "string") {
      this.say(done);
      return false;
    }
    this.run.steps.length = this.run.at;
    this.run.steps.push({ event, at, records: done, why });
    this.run.at += 1;
    return true;
  }

  tell(event) {
    const why = this.state.prospects[event][0] === 0 ? "" : this.engine.why(event, this.when());
    if (this.step(event, this.when(), why)) {
      const step = this.run.steps[this.run.at - 1];
      const [name] = this.data.events[event];
      const fired = step.records.flatMap((it) => it.fired);
      this.show();
      this.say(step.why
        ? `${name}: ${step.why}.`
        : `${name}: ${fired.map((it) => this.data.transitions[it][0]).join(", ")} fired.`);
    }
  }

  pass(at) {
    const is = this.step(null, at, "");
    if (is) {
      const step = this.run.steps[this.run.at - 1];
      this.show();
      this.say(`${seconds(this.state.now)}: ${this.log.said(step)}.`);
    }
    return is;
  }

  /** Lets time run as it passes here, or stops. */
  runs(is) {
    clearInterval(this.timer);
    const tick = () => this.pass(this.state.now + TICK) || this.runs(false);
    this.timer = is ? setInterval(tick, TICK) : null;
    byId("runs").textContent = is ? "stop" : "let time run";
  }

  /** A click in a drawing: the event of one transition is told, of several one is chosen. */
  choose(transitions) {
    const all = transitions.map((id) => this.data.transitions[id]);
    const events = [...new Set(all.map((it) => it[1]).filter((it) => it !== null))];
    if (events.length === 1) {
      this.tell(events[0]);
    } else if (events.length > 1) {
      this.events.look(events);
      byId("events").scrollIntoView({ block: "nearest" });
      this.say("Several events lead here: they are listed.");
    } else if (all.length > 0) {
      this.say(`${all[0][0]} ${all[0][2] || "fires by itself"}.`);
    }
  }

  go(to) {
    const at = Math.min(Math.max(to, 0), this.run.steps.length);
    if (at !== this.run.at) {
      this.engine.go(at);
      this.run.at = at;
      this.show();
      this.say(at === 0 ? "The start." : `After step ${at} of ${this.run.steps.length}.`);
    }
  }

  restart(period) {
    this.runs(false);
    this.engine.start(period);
    this.begin(period);
    byId("rounds").checked = period > 0;
    this.log.last = null;
    this.show();
  }

  /** Plays a run from a file, or from a link; returns whether all of it was played. */
  play(run) {
    this.restart(run.period);
    let all = true;
    for (const { event, at, toggles } of run.steps) {
      const next = at === null ? this.engine.state(0).next : null;
      const due = next ? next.at : at;
      const now = this.now();
      all = this.step(event, due === null ? now : Math.max(due, now), "", toggles);
      if (!all) {
        break;
      }
    }
    this.show();
    if (all && run.fired) {
      this.say(this.compared(run));
    }
    return all;
  }

  /** True if what fired is what a file says. */
  compared(run) {
    const steps = [{ records: this.run.started }, ...this.run.steps];
    const fired = steps.flatMap((step) => step.records.flatMap((it) => it.fired));
    const names = fired.map((it) => this.data.transitions[it][0]);
    const departs = run.fired.findIndex((it, at) => it !== names[at]);
    if (run.fired.length === 0 || (departs < 0 && names.length === run.fired.length)) {
      return `Played: ${run.title}. What fired is what the file says.`;
    }
    const at = departs < 0 ? run.fired.length : departs;
    return `Played: ${run.title}. It departs: firing ${at + 1} is ${names[at] || "none"}, and ` +
      `${run.fired[at] || "none"} in the file. A checker's run may leave open when what is due ` +
      "fires; the player fires it at its first instant.";
  }

  async file(file) {
    if (!file) {
      return;
    }
    await this.attempt(async () => {
      if (file.size > MOST_BYTES) {
        throw new Error("the file is larger than 32 MiB");
      }
      const text = await file.text();
      const answer = answerOf(text);
      if (answer) {
        this.verdicts.load(answer);
        this.show();
      }
      this.found = runsOf(this.data, text, this.run.period);
      const options = this.found.map((it, at) => new Option(visible(it.title), String(at)));
      byId("found").replaceChildren(...options);
      byId("found").hidden = this.found.length < 2;
      if (this.found.length > 0) {
        this.play(this.found[0]);
      } else {
        this.say("Loaded: what was checked. No property in it has a run to show.");
      }
    });
    byId("file").value = "";
  }

  /** Plays the run of the link. */
  follow() {
    const link = ofLink(this.data, location.hash.slice(1));
    if (link.is) {
      this.play(link);
      this.say(`The run of the link: ${this.run.steps.length} steps.`);
    }
    return link.is;
  }

  async attempt(then) {
    try {
      await then();
    } catch (error) {
      this.say(`Not loaded: ${error.message}.`);
    }
  }

  copy() {
    const link = linkOf(this.data, this.linked(), this.run.period);
    if (link === null) {
      this.say("The run is too long for a link: save the recording.");
      return;
    }
    location.replace(`#${link}`);
    this.address = location.hash.slice(1);
    const copied = navigator.clipboard
      ? navigator.clipboard.writeText(location.href)
      : Promise.reject(new Error("no clipboard"));
    const said = (text) => () => this.say(text);
    copied.then(said("The link is copied."), said("The link is in the address."));
  }

  say(text) {
    byId("said").textContent = visible(text);
  }

  show() {
    const { run } = this;
    this.state = this.engine.state(this.when());
    const { state } = this;
    const records = run.at > 0 ? run.steps[run.at - 1].records : run.started;
    this.drawings.show(state, records);
    this.events.show(state);
    this.marking.show(state);
    this.log.show(run);
    this.verdicts.show(state, records);
    byId("now").textContent = seconds(state.now);
    byId("where").max = run.steps.length;
    byId("where").value = run.at;
    byId("steps").textContent = `step ${run.at} of ${run.steps.length}`;
    byId("back").disabled = byId("start").disabled = run.at === 0;
    byId("forth").disabled = byId("end").disabled = run.at === run.steps.length;
    byId("next").hidden = !state.next || run.period > 0;
    if (state.next) {
      const name = this.data.transitions[state.next.transition][0];
      byId("next").textContent = visible(`till ${seconds(state.next.at)}, when ${name} fires`);
    }
    byId("round").hidden = run.period === 0;
    ["tenth", "second"].forEach((id) => {
      byId(id).hidden = run.period > 0;
    });
    const command = commandOf(this.data, run.steps.slice(0, run.at), run.period);
    byId("command").textContent = visible(command);
    // Scrolling asks where everything is: once a frame is enough.
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(() => {
      this.drawings.reveal();
      this.log.reveal();
    });
    clearTimeout(this.later);
    this.later = setTimeout(() => this.link(), LINK_AFTER);
  }

  /** The steps that a link holds. */
  linked() {
    return this.run.steps.slice(0, this.run.at);
  }

  /** Lets the address follow the run. */
  link() {
    this.address = linkOf(this.data, this.linked(), this.run.period) || "";
    history.replaceState(null, "", `#${this.address}`);
  }
}
