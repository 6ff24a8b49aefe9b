// A run as words: those of `cotama simulate`, in a link and on a command line.

/** The longest run that a link holds, in steps. */
const MOST_IN_LINK = 2000;
const MOST_IN_COMMAND = 60;

/** The word of a step after this time. */
function word(data, step, now, encode) {
  const toggles = (step.toggles || []).map((it) => `!${it}`).join("");
  if (step.event === null) {
    return `+${step.at - now}${toggles}`;
  }
  const name = data.events[step.event][0];
  // The first of two events of one name has it.
  const first = data.events.findIndex((it) => it[0] === name) === step.event;
  const said = first ? encode(name) : `:${step.event}`;
  return (step.at === now ? said : `${said}@${step.at}`) + toggles;
}

/** A name in a link, in which `!` comes before what is switched. */
function inLink(name) {
  return encodeURIComponent(name).replace(/!/g, "%21");
}

function wordsOf(data, steps, encode) {
  let now = 0;
  return steps.map((step) => {
    const said = word(data, step, now, encode);
    now = step.at;
    return said;
  });
}

/** The part of a link behind `#`; none if the run is too long for one. */
function linkOf(data, steps, period) {
  if (steps.length > MOST_IN_LINK) {
    return null;
  }
  const words = wordsOf(data, steps, inLink).join(",");
  return (period > 0 ? `rounds=${period}&` : "") + (words ? `run=${words}` : "");
}

/** The steps of a link, and the period of rounds; null where it says none. */
function ofLink(data, link) {
  const said = new Map(link.split("&").map((it) => it.split("=", 2)));
  const period = said.has("rounds") ? Number(said.get("rounds")) : 0;
  const known = Number.isSafeInteger(period) && period >= 0 && period <= 86400000;
  let now = 0;
  const words = (said.get("run") || "").split(",").filter((it) => it);
  const steps = words.map((it) => {
    const step = ofWord(data, it, now);
    now = step.at;
    return step;
  });
  return { period: known ? period : 0, steps, is: said.has("rounds") || said.has("run") };
}

function ofWord(data, whole, now) {
  const [said, ...toggles] = whole.split("!");
  return { ...plainWord(data, said, now), ...(toggles.length > 0 ? { toggles } : {}) };
}

function plainWord(data, said, now) {
  const wait = /^\+(\d{1,15})$/.exec(said);
  if (wait) {
    return { event: null, at: now + Number(wait[1]) };
  }
  const [, name, at] = /^([^@]*)(?:@(\d{1,15}))?$/.exec(said) || [null, "", ""];
  const number = /^:(\d+)$/.exec(name);
  let event = number ? Number(number[1]) : -1;
  if (!number) {
    let plain = name;
    try {
      plain = decodeURIComponent(name);
    } catch (_) {
      // A link that was cut: the name is looked for as it stands.
    }
    event = data.events.findIndex((it) => it[0] === plain);
  }
  if (!(event >= 0 && event < data.events.length)) {
    throw new Error(`the link names an event that the model has not: ${said}`);
  }
  return { event, at: at ? Number(at) : now };
}

function quoted(text) {
  return /^[\w.,:@%+/-]+$/.test(text) ? text : `'${text.replace(/'/g, "'\\''")}'`;
}

/** The command that plays the same. */
function commandOf(data, steps, period) {
  if (data.command === "") {
    return "# no command plays this part of a team";
  }
  if (steps.length > MOST_IN_COMMAND) {
    const so_many = `${steps.length} steps: save the recording`;
    return `cotama simulate ${quoted(data.command)} ... # ${so_many}`;
  }
  // The program passes time by itself in an event; in rounds a wait is a round too.
  const plain = steps.map(({ event, at }) => ({ event, at }));
  const words = wordsOf(data, plain, (it) => it).map(quoted);
  return ["cotama simulate", quoted(data.command), ...(period > 0 ? ["--rounds"] : []), ...words]
    .join(" ");
}

/** The run as JSON lines of `cotama conform`. */
function recordingOf(data, run, end) {
  const lines = [{ schema: "cotama-recording/1" }];
  const put = (record) => {
    const t_ms = record.at;
    if (record.round && run.period > 0) {
      lines.push({ t_ms, round: true });
    }
    if (!data.by_name) {
      const ignored = record.fired.length === 0;
      record.events.forEach((it) => lines.push({ t_ms, event: data.events[it][0], ignored }));
    }
    record.fired.forEach((it) => lines.push({ t_ms, fired: data.transitions[it][0] }));
  };
  run.started.forEach(put);
  run.steps.slice(0, run.at).forEach((step) => step.records.forEach(put));
  lines.push({ t_ms: end, end: true });
  return `${lines.map((it) => JSON.stringify(it)).join("\n")}\n`;
}
