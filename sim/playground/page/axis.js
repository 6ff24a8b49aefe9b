// The axis of a course: a row for each fault, with a handle that is moved by mouse, touch and keys,
// and a row of what the robot does.

/** Handles go by tenths of a second, as rounds do. */
function inRounds100(ms) {
  return Math.round(ms / PERIOD) * PERIOD;
}

/** A length of time that an axis can have: of few different ones, so that it seldom changes. */
function spanOf(ms) {
  const step = ms > 600000 ? 60000 : ms > 60000 ? 10000 : 1000;
  return Math.max(Math.ceil(ms * 1.02 / step) * step, 10000);
}

class Axis {
  /** `moved` is called with the number of an item and its new time. */
  constructor(frame, moved) {
    this.frame = frame;
    this.moved = moved;
    this.span = 10000;
    this.rows = [];
  }

  /** Makes rows for items, each with a name. */
  build(names) {
    this.rows = names.map((name, at) => this.row(name, at));
    this.robot = made("div", "lane");
    this.cursor = made("div", "cursor");
    this.limit = made("div", "limit", "");
    const robot = made("div", "fault", made("span", "label", "the robot"), this.robot);
    this.scale = made("div", "scale");
    this.frame.replaceChildren(...this.rows.map((it) => it.whole), robot, this.scale, this.limit,
      this.cursor);
  }

  row({ name, note, fixed, timeless }, at) {
    const said = made("span", "times");
    const label = made("span", "label", name, " ", said);
    if (note) {
      label.append(made("span", "note", ` ${note}`));
    }
    const latency = made("div", "bar latency");
    const shown = made("div", "bar shown");
    const handle = made("button", "handle", "◆");
    handle.type = "button";
    handle.disabled = fixed;
    const lane = made("div", "lane", latency, shown, handle);
    lane.hidden = Boolean(timeless);
    const whole = made("div", "fault", label, lane);
    const row = { whole, said, latency, shown, handle, lane, name };
    if (!fixed) {
      this.movable(row, at);
    }
    return row;
  }

  movable(row, at) {
    const { handle, lane } = row;
    handle.setAttribute("role", "slider");
    handle.setAttribute("aria-valuemin", "0");
    handle.setAttribute("aria-label", visible(`${row.name} begins`));
    const to = (time) => {
      this.moved(at, Math.min(Math.max(inRounds100(time), 0), this.span));
    };
    handle.addEventListener("pointerdown", (it) => {
      handle.setPointerCapture(it.pointerId);
      handle.focus();
      this.held = true;
      it.preventDefault();
    });
    handle.addEventListener("pointermove", (it) => {
      if (handle.hasPointerCapture(it.pointerId)) {
        const box = lane.getBoundingClientRect();
        to((it.clientX - box.left) / Math.max(box.width, 1) * this.span);
      }
    });
    const done = () => {
      this.held = false;
    };
    handle.addEventListener("pointerup", done);
    handle.addEventListener("pointercancel", done);
    handle.addEventListener("keydown", (it) => {
      const second = it.shiftKey ? 10000 : 1000;
      const page = this.span / 20;
      const by = {
        ArrowLeft: -second, ArrowDown: -second, ArrowRight: second, ArrowUp: second,
        PageDown: -page, PageUp: page, Home: -this.span, End: this.span,
      }[it.key];
      if (by !== undefined && !it.ctrlKey && !it.altKey && !it.metaKey) {
        it.preventDefault();
        to(row.time + by);
      }
    });
  }

  part(it, from, to) {
    it.style.left = `${Math.min(from / this.span, 1) * 100}%`;
    it.style.width = `${Math.max(Math.min(to, this.span) - from, 0) / this.span * 100}%`;
  }

  /** Shows a course: `fates` of the items, `runs` of the robot, its limit. */
  show(items, course, limit) {
    if (!this.held) {
      this.span = spanOf(Math.max(course.end, ...items.map((it) => it.time)));
    }
    items.forEach(({ time, fate, words }, at) => {
      const row = this.rows[at];
      row.time = time;
      row.said.textContent = visible(words);
      row.handle.style.left = `${time / this.span * 100}%`;
      row.handle.classList.toggle("never", fate.began === null);
      row.handle.setAttribute("aria-valuemax", String(this.span));
      row.handle.setAttribute("aria-valuenow", String(time));
      row.handle.setAttribute("aria-valuetext", visible(words));
      const over = fate.over === null ? course.end : fate.over;
      const found = fate.found === null ? over : fate.found;
      row.latency.hidden = row.shown.hidden = fate.began === null;
      if (fate.began !== null) {
        this.part(row.latency, fate.began, found);
        this.part(row.shown, found, fate.found === null ? found : over);
      }
    });
    this.robot.replaceChildren(...course.runs.map(({ from, to, name, kind }) => {
      const it = made("div", `bar ${kind}`, name);
      it.title = visible(`${name}, from ${seconds(from)} to ${seconds(to)}`);
      this.part(it, from, to);
      return it;
    }));
    this.ticks();
    this.limit.hidden = limit === 0 || limit > this.span;
    this.limit.style.setProperty("--at", String(limit / this.span));
    this.limit.title = `the limit on duration, ${seconds(limit)}`;
  }

  ticks() {
    const steps = [1, 2, 5, 10, 30, 60, 120, 300, 600].map((it) => it * 1000);
    const step = steps.find((it) => this.span / it <= 6) || 600000;
    const marks = [];
    for (let at = 0; at <= this.span; at += step) {
      const it = made("span", "", String(at / 1000));
      it.style.left = `${at / this.span * 100}%`;
      marks.push(it);
    }
    this.scale.replaceChildren(...marks);
  }

  point(time) {
    this.cursor.style.setProperty("--at", String(Math.min(time / this.span, 1)));
  }
}
