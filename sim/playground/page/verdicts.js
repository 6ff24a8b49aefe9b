// Requirements of the model that were checked and speak of where one is, from a file that
// `cotama check --json` wrote. The page checks nothing.

/** The most requirements that are shown. */
const MOST_VERDICTS = 8;

class Verdicts {
  constructor(data) {
    this.data = data;
    this.all = [];
    this.number = new Map(data.places.map((it, at) => [it[0], at]));
  }

  /** Takes the answers of a file. */
  load(answer) {
    this.of = answer.model;
    this.all = answer.results.map((it) => ({
      name: it.id || it.name,
      text: it.sentence || it.property,
      verdict: it.verdict,
      how: [it.engine, it.evidence, it.certificate].filter((each) => each && each !== "none"),
      places: this.named(it.property),
    }));
  }

  /** The places that a property names. */
  named(property) {
    const words = property.match(/"(?:[^"\\]|\\.)*"|[\w.!-]+/g) || [];
    const numbers = words.map((it) => this.number.get(it.replace(/^"|"$|^!/g, "")));
    return new Set(numbers.filter((it) => it !== undefined));
  }

  /** Requirements of which a place has just changed come first, then those of which one is marked. */
  show(state, records) {
    if (this.all.length === 0) {
      return;
    }
    const changed = new Set(records.flatMap((it) => it.changed.map((change) => change[0])));
    const rank = (it) => [...it.places].reduce((sum, at) => sum
      + (changed.has(at) ? 100 : 0) + (state.tokens[at] > 0 ? 1 : 0), 0) / (it.places.size + 1);
    const ranked = this.all.map((it) => [rank(it), it]).filter((it) => it[0] > 0);
    ranked.sort((a, b) => b[0] - a[0]);
    const rows = ranked.slice(0, MOST_VERDICTS).map(([, it]) => {
      const verdict = made("span", `verdict ${it.verdict}`, it.verdict);
      const text = it.name === it.text ? it.text : `${it.name}: ${it.text}`;
      return made("li", "", verdict, ` ${text} `,
        made("span", "note", it.how.join(", ")));
    });
    const more = this.all.length - rows.length;
    byId("verdicts").replaceChildren(...rows);
    const other = this.of === this.data.command ? "" : ` They are of ${this.of}, not of this page.`;
    const counts = `${rows.length} speak of where this is, ${more} do not.`;
    byId("checked").textContent = visible(`${this.all.length} were checked; ${counts}${other}`);
  }
}
