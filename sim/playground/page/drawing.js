// The drawings: tokens as they are, what would fire, and what has fired.

const DOTS = {
  1: [[0, 0]],
  2: [[-5, 0], [5, 0]],
  3: [[0, -5], [-5, 4], [5, 4]],
  4: [[-5, -5], [5, -5], [-5, 5], [5, 5]],
};

/** Tokens in the circle of a place: dots, from five on a number. */
function drawTokens(place, tokens) {
  place.querySelectorAll(".token,.count").forEach((it) => it.remove());
  const rim = place.querySelector(".rim");
  if (!rim || tokens === 0) {
    return;
  }
  const [x, y] = [Number(rim.getAttribute("cx")), Number(rim.getAttribute("cy"))];
  const add = (name, attributes) => {
    const it = document.createElementNS("http://www.w3.org/2000/svg", name);
    Object.entries(attributes).forEach(([key, value]) => it.setAttribute(key, value));
    return place.appendChild(it);
  };
  if (tokens > 4) {
    const size = tokens < 10000 ? 11 : 5;
    add("text", { class: "count middle", x, y: y + 3, style: `font-size:${size}px` })
      .textContent = String(tokens);
    return;
  }
  const r = tokens === 1 ? 5 : 4;
  DOTS[tokens].forEach(([right, down]) => {
    add("circle", { class: "token", cx: x + right, cy: y + down, r });
  });
}

function colour(it, kind, is) {
  it.classList.toggle(kind, is);
  it.querySelectorAll("text").forEach((text) => text.classList.toggle(kind, is));
}

/** Scrolls a drawing in its frame to where something is marked or has fired. */
function reveal(net) {
  const frame = net.querySelector(".scroll");
  const hot = ".state.hot rect,.place.hot .rim,.transition.hot rect";
  const it = frame && (frame.querySelector(hot) || frame.querySelector(".part.can"));
  if (!it || frame.clientWidth === 0) {
    return;
  }
  const [box, around] = [it.getBoundingClientRect(), frame.getBoundingClientRect()];
  if (box.left < around.left || box.right > around.right) {
    frame.scrollLeft += box.left - around.left - frame.clientWidth / 2;
  }
  if (box.top < around.top || box.bottom > around.bottom) {
    frame.scrollTop += box.top - around.top - frame.clientHeight / 2;
  }
}

/** All drawings of a page. `choose` is called with the transitions of what is clicked. */
class Drawings {
  constructor(data, choose) {
    this.data = data;
    this.places = [];
    this.parts = [];
    this.shown = [];
    data.nets.forEach((net, at) => {
      net.places.forEach((id, own) => {
        const it = byId(`n${at}-place-${own}`);
        if (it && id !== null) {
          this.places.push([id, it]);
        }
      });
      net.parts.forEach(([id, own]) => {
        const it = byId(`n${at}-${id}`);
        if (it) {
          this.part(it, own.map((number) => net.first + number), choose);
        }
      });
    });
  }

  part(it, transitions, choose) {
    this.parts.push([it, transitions]);
    it.classList.add("part");
    it.addEventListener("click", () => choose(transitions));
    if (transitions.some((id) => this.data.transitions[id][1] !== null)) {
      it.setAttribute("tabindex", "0");
      it.setAttribute("role", "button");
      it.addEventListener("keydown", (event) => {
        if (event.key === "Enter" || event.key === " ") {
          event.preventDefault();
          choose(transitions);
        }
      });
    }
  }

  /** Shows a state, and the records that led to it. */
  show(state, records) {
    const fired = new Set(records.flatMap((it) => it.fired));
    const changed = new Set(records.flatMap((it) => it.changed.map((change) => change[0])));
    const usable = new Set(state.prospects.filter((it) => it[0] === 0).map((it) => it[1]));
    this.places.forEach(([id, it], at) => {
      const tokens = state.tokens[id];
      const look = `${tokens} ${changed.has(id)}`;
      if (this.shown[at] === look) {
        return;
      }
      this.shown[at] = look;
      drawTokens(it, tokens);
      colour(it, "hot", it.classList.contains("state") ? tokens > 0 : changed.has(id));
    });
    this.parts.forEach((part) => {
      const [it, transitions, before] = part;
      const [hot, can] = [fired, usable].map((all) => transitions.some((id) => all.has(id)));
      const look = `${hot} ${can}`;
      if (before !== look) {
        part[2] = look;
        colour(it, "hot", hot);
        it.classList.toggle("can", can);
      }
    });
    this.data.nets.forEach((net, at) => {
      const last = this.data.nets[at + 1];
      const end = last ? last.first : this.data.transitions.length;
      const moved = [...fired].some((id) => id >= net.first && id < end);
      byId(`net-${at}`).classList.toggle("moved", moved);
    });
  }

  /** Scrolls the nets that have moved to where. */
  reveal() {
    const moved = document.querySelectorAll(".net.moved");
    // At the start nothing has moved: a net alone shows what could.
    (moved.length > 0 ? moved : document.querySelectorAll(".net:only-child")).forEach(reveal);
  }
}
