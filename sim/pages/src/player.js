// A slider through the time of a run, with a button, keys, and one cursor for all drawings of the page. A
// page gives what is to be shown at a time in ms; it returns words for it.
var PLAYER = (function () {
  "use strict";
  // The row of a list by its first column: the last one that is not after the key.
  function before(all, key) {
    var low = 0, high = all.length;
    while (low < high) {
      var middle = (low + high) >> 1;
      if (all[middle][0] <= key) { low = middle + 1; } else { high = middle; }
    }
    return Math.max(low - 1, 0);
  }
  function between(all, key, column) {
    var at = before(all, key), from = all[at], to = all[Math.min(at + 1, all.length - 1)];
    var span = to[0] - from[0];
    var share = span > 0 ? Math.min(Math.max((key - from[0]) / span, 0), 1) : 0;
    return from[column] + (to[column] - from[column]) * share;
  }
  function start(section, show) {
    var slider = section.querySelector("input");
    var button = section.querySelector("button");
    var output = section.querySelector("output");
    var speed = Number(slider.getAttribute("data-speed"));
    var end = Number(slider.max);
    var playing = 0;
    function cursors(act) {
      Array.prototype.forEach.call(document.querySelectorAll("line.cursor"), function (line) {
        act(line, Number(line.getAttribute("data-left")), Number(line.getAttribute("data-right")));
      });
    }
    function draw() {
      var time = Number(slider.value);
      output.textContent = show(time);
      slider.setAttribute("aria-valuetext", output.textContent);
      cursors(function (line, left, right) {
        var x = left + (right - left) * time / Math.max(end, 1);
        line.setAttribute("x1", x);
        line.setAttribute("x2", x);
      });
    }
    function to(time) { slider.value = Math.min(Math.max(time, 0), end); draw(); }
    function stop() { playing = 0; button.textContent = "Play"; }
    function step(last) {
      return function (now) {
        if (!playing) { return; }
        to(Number(slider.value) + (now - last) * speed);
        if (Number(slider.value) >= end) { stop(); return; }
        requestAnimationFrame(step(now));
      };
    }
    function toggle() {
      if (playing) { stop(); return; }
      playing = 1;
      button.textContent = "Pause";
      if (Number(slider.value) >= end) { slider.value = 0; }
      requestAnimationFrame(function (now) { requestAnimationFrame(step(now)); });
    }
    button.addEventListener("click", toggle);
    slider.addEventListener("input", draw);
    section.addEventListener("keydown", function (event) {
      var second = event.shiftKey ? 10000 : 1000, page = Math.max(end / 20, 1000);
      var ways = { ArrowLeft: -second, ArrowRight: second, PageDown: -page, PageUp: page };
      var time = Number(slider.value) + (ways[event.key] || 0);
      if (event.key === " " && event.target !== button) { toggle(); }
      else if (event.key === "Home") { to(0); }
      else if (event.key === "End") { to(end); }
      else if (ways[event.key] && !event.ctrlKey && !event.altKey && !event.metaKey) { to(time); }
      else { return; }
      event.preventDefault();
    });
    // A click on a drawing with a cursor moves it there.
    cursors(function (line, left, right) {
      var drawing = line.ownerSVGElement;
      drawing.addEventListener("click", function (event) {
        var box = drawing.getBoundingClientRect(), view = drawing.viewBox.baseVal;
        var x = (event.clientX - box.left) * view.width / Math.max(box.width, 1);
        to((x - left) / Math.max(right - left, 1) * end);
      });
    });
    document.body.classList.add("plays");
    draw();
  }
  return {
    before: before,
    between: between,
    // The drawings with cursors stand below.
    start: function (section, show) {
      document.addEventListener("DOMContentLoaded", function () { start(section, show); });
    }
  };
})();
