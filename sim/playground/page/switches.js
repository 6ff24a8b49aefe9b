// Switches of a robot: failures and flags, and the status vector.

class Switches {
  constructor(robot, toggle) {
    this.robot = robot;
    const row = (word, name, ...lines) => {
      const own = button("", () => toggle(word));
      own.className = "switch";
      own.setAttribute("role", "switch");
      const is = made("span", "is", "off");
      own.append(made("span", "name", name), is, ...lines.map((it) => made("span", "note", it)));
      return { own, is, word, text: [name, ...lines].join(" ").toLowerCase() };
    };
    this.failures = robot.failures.map((it, at) => row(`m${at}`, `${it.id} ${it.what}`,
      this.about(it)));
    this.flags = robot.flags.map(([flag, observer], at) => row(`f${at}`, flag,
      `${observer || "an observer"} raises it; shows ${this.shows(at)}`));
    byId("failures").append(...this.failures.map((it) => it.own));
    byId("flags").append(...this.flags.map((it) => it.own));
    byId("seek").addEventListener("input", (it) => {
      const text = it.target.value.trim().toLowerCase();
      [...this.failures, ...this.flags].forEach((row) => {
        row.own.hidden = !row.text.includes(text);
      });
    });
  }

  about(it) {
    const [alone, operator] = it.severity;
    const how = alone === operator ? alone : `${alone}, with the operator ${operator}`;
    const loses = it.loses.length > 0 ? `; takes ${it.loses.join(", ")}` : "";
    const shown = it.flags.map((at) => this.robot.flags[at][0]).join(", ");
    const seen = it.unseen ? `not seen: ${it.unseen}`
      : `seen by ${shown || "flags at times"} after ${seconds(it.latency_ms)}`;
    return `${how}${loses}; ${seen}`;
  }

  shows(flag) {
    const all = this.robot.failures.filter((it) => it.flags.includes(flag)
      || it.sometimes.includes(flag));
    return all.map((it) => it.id).join(", ") || "nothing";
  }

  show(world) {
    const up = world.up();
    this.failures.forEach((it) => this.one(it, world.is(it.word), "on", "off"));
    this.flags.forEach((it, at) => this.one(it, has(up, at), "up", "down"));
  }

  one({ own, is }, on, yes, no) {
    const text = on ? yes : no;
    if (is.textContent !== text) {
      is.textContent = text;
      own.classList.toggle("on", on);
      own.setAttribute("aria-checked", String(on));
    }
  }
}

/** The status vector: what the robot does, with what, and what it is asked for. */
class Status {
  constructor(robot) {
    this.robot = robot;
  }

  lines(it, world) {
    const { robot } = this;
    const [kind, sub, configuration] = it.place;
    const known = robot.losses.filter((_, at) => has([it.lost, 0], at));
    const runs = robot.configurations[configuration];
    const held = robot.reports.filter((_, at) => has(it.settings, at));
    const requests = [
      it.halt && "motor power off, for good", it.ask && "the operator is asked",
      it.alarm && "alarm",
    ].filter(Boolean);
    const mode = kind === 2 && robot.sub_objectives[sub][1] ? " (the operator drives)" : "";
    return [
      ["mission", it.global[0] === 1 ? robot.objectives[it.global[1]] : GLOBALS[it.global[0]]],
      ["robot", kind === 2 ? robot.sub_objectives[sub][0] + mode : PLACES[kind]],
      ["configuration", kind === 2
        ? `${runs.name}: ${runs.required.join(", ") || "no module"}` : "none runs"],
      ["may move", it.drive ? `yes, at most ${it.speed} mm/s` : "no"],
      ["known losses", known.join(", ") || "none"],
      ["settings", held.map((name) => `that of ${name}`).join(", ") || "as planned"],
      ["requests", requests.join(", ") || "none"],
      ["has failed", [...new Set([...world.failures, ...world.unseen])]
        .map((at) => robot.failures[at].id).join(", ") || "nothing"],
    ];
  }

  show(it, world) {
    const rows = this.lines(it, world).flatMap(([name, text]) => [
      made("dt", "", name), made("dd", "", text),
    ]);
    byId("status").replaceChildren(...rows);
  }
}
