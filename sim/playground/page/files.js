// Runs from files: what `cotama check --json` found, and what `cotama simulate --trace`, a robot
// or this page recorded.

/** The largest file that is read, in bytes. */
const MOST_BYTES = 32 << 20;

/** The answer of `cotama check --json` in a text, if it is one. */
function answerOf(text) {
  try {
    const answer = JSON.parse(text);
    return answer.schema === "cotama/check/1" ? answer : null;
  } catch (_) {
    return null;
  }
}

/** The runs in a text: each with a title, its steps, and what fired, by name. */
function runsOf(data, text, period) {
  let whole = null;
  try {
    whole = JSON.parse(text);
  } catch (_) {
    // Lines of JSON, then.
  }
  if (whole && whole.schema === "cotama/check/1") {
    return checkedRuns(data, whole, period);
  }
  if (whole && whole.schema !== "cotama-recording/1") {
    throw new Error("neither an answer of `cotama check --json` nor a recorded run");
  }
  return [recordedRun(data, text.split("\n"))];
}

function eventNamed(data, name) {
  const event = data.events.findIndex((it) => it[0] === name);
  if (event < 0) {
    throw new Error(`the model has no event ${name}`);
  }
  return event;
}

function checkedRuns(data, answer, period) {
  const with_run = answer.results.filter((it) => it.trace && it.trace.length > 0);
  return with_run.map((it) => {
    const title = `${it.verdict}: ${(it.sentence || it.name).replace(/\.$/, "")}`;
    return answer.semantics === "rounds"
      ? { title, ...inRounds(data, it.trace, period || 100) }
      : { title, ...oneByOne(data, it.trace) };
  });
}

/** A run of a system that acts in rounds: each ends with an event from outside, or `idle`. */
function inRounds(data, trace, period) {
  const steps = [];
  const fired = [];
  let open = false;
  trace.forEach((it) => {
    const is_outside = it.event !== undefined;
    open = true;
    if (is_outside || it.transition === "idle") {
      const event = is_outside ? eventNamed(data, it.event) : null;
      steps.push({ event, at: (steps.length + 1) * period });
      open = false;
    }
    if (it.transition !== "idle") {
      const names = it.transition.replace(/ #\d+$/, "").split(" + ");
      fired.push(...names.filter((name) => !name.includes(" ")));
    }
  });
  if (open) {
    steps.push({ event: null, at: (steps.length + 1) * period });
  }
  return { steps, fired, period };
}

/** A run of a net: events are told; what fires by itself has its date, or waits for its own. */
function oneByOne(data, trace) {
  const names = new Set(data.by_name ? data.events.map((it) => it[0]) : []);
  let now = 0;
  const steps = trace.map((it) => {
    const date = it.time === undefined ? null : Math.ceil(Number(it.time));
    now = date === null ? now : Math.max(now, date);
    if (it.event !== undefined) {
      return { event: eventNamed(data, it.event), at: now };
    }
    if (names.has(it.transition)) {
      return { event: eventNamed(data, it.transition), at: now };
    }
    return { event: null, at: date === null ? null : now };
  });
  return { steps, fired: trace.map((it) => it.transition), period: 0 };
}

/** A recorded run: what was told, when, and whether in rounds. */
function recordedRun(data, lines) {
  const run = { title: "recorded run", steps: [], fired: [], period: 0 };
  let every = 0;
  let next = 0;
  lines.forEach((line, at) => {
    if (!line.trim()) {
      return;
    }
    let it = null;
    try {
      it = JSON.parse(line);
    } catch (_) {
      throw new Error(`line ${at + 1} is no JSON`);
    }
    if (it.schema !== undefined) {
      every = it.round_every_ms || 0;
      run.period = every;
      return;
    }
    if (!Number.isSafeInteger(it.t_ms) || it.t_ms < 0) {
      throw new Error(`line ${at + 1} has no time`);
    }
    for (; every > 0 && next <= it.t_ms && run.steps.length < 100000; next += every) {
      run.steps.push({ event: null, at: next });
    }
    recordedLine(data, run, it, every > 0);
  });
  return run;
}

function recordedLine(data, run, it, has_period) {
  const last = run.steps[run.steps.length - 1];
  if (it.round) {
    run.period = run.period || 100;
    run.steps.push({ event: null, at: it.t_ms });
  } else if (it.event !== undefined) {
    const event = eventNamed(data, it.event);
    if (run.period > 0 && last && last.event === null && last.at <= it.t_ms) {
      last.event = event;
    } else if (run.period > 0) {
      throw new Error("it tells two events in a round, which a page in rounds cannot");
    } else {
      run.steps.push({ event, at: it.t_ms });
    }
  } else if (it.fired !== undefined) {
    run.fired.push(it.fired);
  } else if (it.end && !has_period && last && last.at < it.t_ms && run.period === 0) {
    run.steps.push({ event: null, at: it.t_ms });
  }
}
