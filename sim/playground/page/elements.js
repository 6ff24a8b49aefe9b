// Elements of the page; names reach it as text alone.

function byId(id) {
  return document.getElementById(id);
}

/** A text in which characters that are obeyed or hidden, as those that turn lines, are codes. */
function visible(text) {
  const code = (it) => `\\u{${it.codePointAt(0).toString(16)}}`;
  return text.replace(/[\p{Cc}\p{Cf}\u2028\u2029]/gu, code);
}

/** An element with a class and what stands in it: texts and elements. */
function made(name, kind, ...inside) {
  const it = document.createElement(name);
  if (kind) {
    it.className = kind;
  }
  it.append(...inside.map((each) => (typeof each === "string" ? visible(each) : each)));
  return it;
}

function button(text, then) {
  const it = made("button", "", text);
  it.type = "button";
  it.addEventListener("click", then);
  return it;
}

/** Seconds of milliseconds, without zeros at the end. */
function seconds(ms) {
  return `${Math.floor(ms / 1000)}.${String(ms % 1000).padStart(3, "0").replace(/00?$/, "")} s`;
}

/** Shows a text as a file to be saved. */
function save(name, text) {
  const link = made("a", "");
  link.href = URL.createObjectURL(new Blob([text], { type: "application/json" }));
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}
