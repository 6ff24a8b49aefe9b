// Moves the robot along its way to the time of the slider. Without it the page shows the way and the
// points of the story.
(function () {
  "use strict";
  var section = document.querySelector(".onfloor");
  var robot = section.querySelector(".robot");
  var people = section.querySelectorAll("circle.person");
  var rays = section.querySelector("path.rays"), told = section.querySelector("circle.told");
  var before = PLAYER.before, between = PLAYER.between;
  // Between two headings the shorter way round.
  function heading(time) {
    var at = before(RUN.poses, time), from = RUN.poses[at];
    var to = RUN.poses[Math.min(at + 1, RUN.poses.length - 1)], span = to[0] - from[0];
    var turn = ((to[3] - from[3]) % 360 + 540) % 360 - 180;
    return from[3] + (span > 0 ? turn * Math.min(Math.max((time - from[0]) / span, 0), 1) : 0);
  }
  PLAYER.start(section, function (time) {
    if (!RUN.samples.length || !RUN.way.length) { return ""; }
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
    var now = before(RUN.poses, time), next = Math.min(now + 1, RUN.poses.length - 1);
    Array.prototype.forEach.call(people, function (person, number) {
      var x = 6 + 2 * number, here = RUN.poses[now] && RUN.poses[now][x] !== undefined;
      var stays = here && RUN.poses[next][x] === undefined;
      person.setAttribute("visibility", here ? "visible" : "hidden");
      if (!here) { return; }
      person.setAttribute("cx", stays ? RUN.poses[now][x] : between(RUN.poses, time, x));
      person.setAttribute("cy", stays ? RUN.poses[now][x + 1] : between(RUN.poses, time, x + 1));
    });
    if (rays) {
      var ends = RUN.rays[now] || [], drawn = "";
      for (var ray = 0; ray + 1 < ends.length; ray += 2) {
        drawn += "M" + at_x + " " + at_y + "L" + ends[ray] + " " + ends[ray + 1];
      }
      rays.setAttribute("d", drawn);
    }
    if (told) { told.setAttribute("visibility", RUN.poses.length ? "visible" : "hidden"); }
    if (told && RUN.poses.length) {
      told.setAttribute("cx", between(RUN.poses, time, 4));
      told.setAttribute("cy", between(RUN.poses, time, 5));
    }
    robot.setAttribute("transform", "translate(" + at_x + " " + at_y + ") rotate(" + turn + ")");
    var sample = RUN.samples[before(RUN.samples, time)];
    var runs = RUN.runs.length && RUN.runs[0][0] <= time ? RUN.runs[before(RUN.runs, time)][1] : "";
    return (time / 1000).toFixed(1) + " s, " + (along / 1000).toFixed(1) + " m, " +
      sample[2] + " mm/s" + (runs ? ", " + runs : "") + (sample.length < 5 ? "" : "; margins " +
      (sample[3] / 1000).toFixed(1) + " s, " + (sample[4] / 1000).toFixed(0) + " J");
  });
})();
