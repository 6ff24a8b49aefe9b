(function () {
  "use strict";
  var figure = document.currentScript.parentNode;
  var player = figure.querySelector(".player");
  var slider = player.querySelector("input");
  function read(name) { return JSON.parse(player.getAttribute("data-" + name)); }
  // Each step: what fires, its name, and the tokens of the places that it changes; first the
  // start. Then what to colour: ids of elements, each with the transitions that it belongs to.
  var steps = read("run"), parts = read("parts");
  var places = {};
  figure.querySelectorAll("[id^=place-]").forEach(function (it) { places[it.id.slice(6)] = it; });
  var dots = { 1: [[0, 0]], 2: [[-5, 0], [5, 0]], 3: [[0, -5], [-5, 4], [5, 4]],
    4: [[-5, -5], [5, -5], [-5, 5], [5, 5]] };
  function draw(place, tokens) {
    place.querySelectorAll(".token,.count").forEach(function (it) { it.remove(); });
    var rim = place.querySelector(".rim");
    if (!rim || !tokens) { return; }
    var x = Number(rim.getAttribute("cx")), y = Number(rim.getAttribute("cy"));
    function add(name, attributes) {
      var it = document.createElementNS(rim.namespaceURI, name);
      Object.keys(attributes).forEach(function (key) { it.setAttribute(key, attributes[key]); });
      return place.appendChild(it);
    }
    if (tokens > 4) {
      add("text", { "class": "count middle", x: x, y: y + 3 }).textContent = tokens;
    } else {
      dots[tokens].forEach(function (dot) {
        add("circle", { "class": "token", cx: x + dot[0], cy: y + dot[1],
          r: tokens === 1 ? 5 : 4 });
      });
    }
  }
  function hot(it, is) {
    it.classList.toggle("hot", is);
    it.querySelectorAll("text").forEach(function (text) { text.classList.toggle("hot", is); });
  }
  function show() {
    var at = Number(slider.value), step = steps[at], tokens = {}, changed = {};
    steps.slice(0, at + 1).forEach(function (it) {
      it[2].forEach(function (change) { tokens[change[0]] = change[1]; });
    });
    step[2].forEach(function (change) { changed[change[0]] = at > 0; });
    Object.keys(places).forEach(function (key) {
      var place = places[key], count = tokens[key] || 0;
      draw(place, count);
      if (place.classList.contains("state")) {
        place.classList.toggle("hot", count > 0);
      } else {
        hot(place, Boolean(changed[key]));
      }
    });
    figure.classList.toggle("ended", at + 1 === steps.length);
    parts.forEach(function (part) {
      hot(figure.querySelector("#" + part[0]), at > 0 ? part[1].indexOf(step[0]) !== -1 : false);
    });
    document.querySelectorAll(".diagnosis tr[data-step]").forEach(function (row) {
      row.classList.toggle("now", row.getAttribute("data-step") === slider.value);
    });
    player.querySelector("output").textContent =
      at > 0 ? at + " of " + (steps.length - 1) + ": " + step[1] : "start";
    var first = figure.querySelector(".transition.hot rect,.state.hot rect,.hot .rim");
    if (first) {
      var box = first.getBoundingClientRect(), frame = figure.querySelector(".scroll");
      frame.scrollLeft += box.left - frame.getBoundingClientRect().left - frame.clientWidth / 2;
    }
  }
  function go(by) {
    slider.value = Number(slider.value) + by;
    show();
  }
  slider.addEventListener("input", show);
  player.querySelectorAll("button").forEach(function (it) {
    it.addEventListener("click", function () { go(Number(it.value)); });
  });
  document.addEventListener("keydown", function (event) {
    if (event.target === slider) { return; }
    if (event.key === "ArrowRight") { go(1); } else if (event.key === "ArrowLeft") { go(-1); }
  });
  player.hidden = false;
  show();
}());
