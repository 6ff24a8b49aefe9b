// Moves the robot along its way, and the cursors of the curves, to the time of the slider. Without it
// the page shows the way and the points of the story.
(function () {
  "use strict";
  var section = document.querySelector(".onfloor");
  var robot = section.querySelector(".robot");
  var people = section.querySelectorAll("circle.person");
  var slider = section.querySelector("input");
  var button = section.querySelector("button");
  var output = section.querySelector("output");
  var playing = 0;
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
  // Between two headings the shorter way round.
  function heading(time) {
    var at = before(RUN.poses, time), from = RUN.poses[at];
    var to = RUN.poses[Math.min(at + 1, RUN.poses.length - 1)], span = to[0] - from[0];
    var turn = ((to[3] - from[3]) % 360 + 540) % 360 - 180;
    return from[3] + (span > 0 ? turn * Math.min(Math.max((time - from[0]) / span, 0), 1) : 0);
  }
  function show() {
    var time = Number(slider.value);
    if (!RUN.samples.length || !RUN.way.length) { return; }
    var along = between(RUN.samples, time, 1);
    var at = before(RUN.way, along);
    var from = RUN.way[Math.min(at, RUN.way.length - 2)] || RUN.way[0];
    var to = RUN.way[Math.min(at + 1, RUN.way.length - 1)];
    var turn = Math.atan2(to[2] - from[2], to[1] - from[1]) * 180 / Math.PI;
    var at_x = between(RUN.way, along, 1), at_y = between(RUN.way, along, 2);
    if (RUN.poses.length) {
      at_x = between(RUN.poses, time, 1);
      at_y = between(RUN.poses, time, 2);
      turn = heading(time);
    }
    Array.prototype.forEach.call(people, function (person, number) {
      person.setAttribute("cx", between(RUN.poses, time, 4 + 2 * number));
      person.setAttribute("cy", between(RUN.poses, time, 5 + 2 * number));
    });
    robot.setAttribute("transform", "translate(" + at_x + " " + at_y + ") rotate(" + turn + ")");
    var sample = RUN.samples[before(RUN.samples, time)];
    var runs = RUN.runs.length && RUN.runs[0][0] <= time ? RUN.runs[before(RUN.runs, time)][1] : "";
    output.textContent = (time / 1000).toFixed(1) + " s, " + (along / 1000).toFixed(1) + " m, " +
      sample[2] + " mm/s" + (runs ? ", " + runs : "") + "; margins " +
      (sample[3] / 1000).toFixed(1) + " s, " + (sample[4] / 1000).toFixed(0) + " J";
    slider.setAttribute("aria-valuetext", output.textContent);
    Array.prototype.forEach.call(document.querySelectorAll("line.cursor"), function (line) {
      var left = Number(line.getAttribute("data-left"));
      var right = Number(line.getAttribute("data-right"));
      var x = left + (right - left) * time / Math.max(Number(slider.max), 1);
      line.setAttribute("x1", x);
      line.setAttribute("x2", x);
    });
  }
  function step(last) {
    return function (now) {
      if (!playing) { return; }
      slider.value = Number(slider.value) + (now - last) * 20;
      show();
      if (Number(slider.value) >= Number(slider.max)) { stop(); return; }
      requestAnimationFrame(step(now));
    };
  }
  function stop() { playing = 0; button.textContent = "Play"; }
  button.addEventListener("click", function () {
    if (playing) { stop(); return; }
    playing = 1;
    button.textContent = "Pause";
    if (Number(slider.value) >= Number(slider.max)) { slider.value = 0; }
    requestAnimationFrame(function (now) { requestAnimationFrame(step(now)); });
  });
  slider.addEventListener("input", show);
  document.body.classList.add("plays");
  // The curves stand below.
  document.addEventListener("DOMContentLoaded", show);
  show();
})();
