// Lists beside the drawings: events, places, what has happened.

const REASONS = ["", "ignored on purpose", "not now", "too early", "too late", "full"];
/** The most rows of what has happened. */
const MOST_ROWS = 100;
/** From so many events on there is a field to look for one. */
const MANY_EVENTS = 12;

/** The events, each with what it would do. */
class Events {
  constructor(data, tell) {
    this.data = data;
    this.rows = data.events.map(([name, doc], event) => {
      const effect = made("span", "effect");
      const it = button("", () => tell(event));
      it.className = "event";
      it.append(made("span", "name", name), effect);
      if (doc) {
        it.append(made("span", "note", doc));
      }
      byId("events").append(it);
      return { it, effect, name: `${name} ${doc}`.toLowerCase(), look: "" };
    });
    byId("find").hidden = this.rows.length < MANY_EVENTS;
    byId("find").addEventListener("input", () => this.look(null));
    byId("usable").addEventListener("change", () => this.look(null));
    byId("usable").parentNode.hidden = this.rows.length < MANY_EVENTS;
    this.chosen = null;
  }

  /** Shows some events alone, or with null those that are looked for. */
  look(chosen) {
    this.chosen = chosen;
    const text = byId("find").value.trim().toLowerCase();
    const usable = byId("usable").checked;
    this.rows.forEach(({ it, name, look }, event) => {
      const is = chosen
        ? chosen.includes(event)
        : name.includes(text) && !(usable && look.startsWith("–"));
      it.hidden = !is;
    });
    byId("all").hidden = chosen === null;
  }

  show(state) {
    this.rows.forEach((row, event) => {
      const [reason, transition] = state.prospects[event];
      const is = reason === 0;
      const look = is
        ? `▶ ${this.data.by_name ? "fires" : this.data.transitions[transition][0]}`
        : `– ${REASONS[reason]}`;
      if (row.look !== look) {
        row.look = look;
        row.effect.textContent = visible(look);
        row.it.classList.toggle("can", is);
      }
    });
    if (byId("usable").checked) {
      this.look(this.chosen);
    }
  }
}

/** The places that hold something. */
class Marking {
  constructor(data) {
    this.data = data;
    this.look = "";
  }

  show(state) {
    const held = this.data.places
      .map(([name, shown, mail], at) => ({ name, shown, mail, tokens: state.tokens[at] }))
      .filter((it) => it.shown && it.tokens > 0);
    const look = held.map((it) => `${it.name} ${it.tokens}`).join("\n");
    if (look === this.look) {
      return;
    }
    this.look = look;
    byId("marking").replaceChildren(...held.map(({ name, mail, tokens }) => {
      const text = (mail ? `✉ ${name}` : name) + (tokens > 1 ? ` × ${tokens}` : "");
      return made("li", mail ? "mail" : "", text);
    }));
  }
}

/** All that has happened, step by step. */
class Log {
  constructor(data, go) {
    this.data = data;
    this.go = go;
    this.last = null;
  }

  /** A row of a step; `whys` are reasons of this moment, in words. */
  row(run, at) {
    const step = run.steps[at - 1];
    const told = step.event === null
      ? (run.period > 0 ? "a round" : "time")
      : this.data.events[step.event][0];
    const cells = [String(at), seconds(step.at), told, this.said(step)];
    const row = made("tr", "", ...cells.map((it) => made("td", "", it)));
    row.step = at;
    row.addEventListener("click", () => this.go(at));
    return row;
  }

  said(step) {
    const name = (id) => this.data.transitions[id][0];
    const all = step.records.filter((it) => it.fired.length > 0 || it.unused.length > 0);
    const parts = all.map((it) => {
      const fired = it.fired.map(name).join(" + ");
      const says = it.emitted.map((id) => this.data.outputs[id]).join(", ");
      const at = it.at === step.at ? "" : `${seconds(it.at)}: `;
      const unused = it.unused.map((pair) => REASONS[pair[1]]).join(", ");
      return at + (fired || unused) + (says ? ` (says ${says})` : "");
    });
    return (parts.join("; ") || "nothing") + (step.why ? `: ${step.why}` : "");
  }

  show(run) {
    const body = byId("log");
    const first = Math.max(1, run.at - MOST_ROWS + 1);
    const grown = this.last === run.steps.length - 1 && run.at === run.steps.length;
    if (grown && body.lastChild) {
      body.append(this.row(run, run.at));
      if (body.childElementCount > MOST_ROWS) {
        body.firstChild.remove();
      }
    } else {
      const end = Math.min(run.steps.length, Math.max(run.at + 20, first + MOST_ROWS - 1));
      const rows = [];
      for (let at = first; at <= end; at += 1) {
        rows.push(this.row(run, at));
      }
      body.replaceChildren(...rows);
    }
    this.last = run.at === run.steps.length ? run.at : null;
    for (const row of body.children) {
      row.classList.toggle("now", row.step === run.at);
      row.classList.toggle("later", row.step > run.at);
    }
  }

  /** Scrolls to the present step. */
  reveal() {
    const now = byId("log").querySelector(".now");
    const frame = byId("log").closest(".rows");
    if (now) {
      frame.scrollTop = now.offsetTop - frame.clientHeight / 2;
    }
  }
}
