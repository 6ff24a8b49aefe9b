// Moves robots and tasks to the time of the slider. Without it the page shows robots at their start.
(function () {
  "use strict";
  var section = document.querySelector(".onfloor");
  var bots = section.querySelectorAll(".bot");
  var items = section.querySelectorAll(".item[transform]");
  var lines = section.querySelectorAll(".now.robots li");
  var rows = section.querySelectorAll(".now.tasks li");
  var before = PLAYER.before, between = PLAYER.between;
  var words = { waits: "waits", awarded: "is awarded to ", carried: "is on board of ",
    done: "is done", reported: "is reported" };
  function move(it, x, y) {
    it.setAttribute("transform", "translate(" + x.toFixed(1) + " " + y.toFixed(1) + ")");
  }
  // The radius of discs, which is larger on narrow screens.
  function radius() {
    return parseFloat(getComputedStyle(bots[0].querySelector("circle")).r) || RUN.radius;
  }
  // Robots at the same spot stand in a row, the middle of which is the spot.
  function spread(places, reach) {
    var near = reach * 0.8;
    return places.map(function (own, number) {
      var group = [];
      places.forEach(function (other, at) {
        if (Math.abs(own[0] - other[0]) < near && Math.abs(own[1] - other[1]) < near) { group.push(at); }
      });
      var off = (group.indexOf(number) - (group.length - 1) / 2) * reach * 1.9;
      return [own[0] + off, own[1]];
    });
  }
  PLAYER.start(section, function (time) {
    var count = { waits: 0, awarded: 0, carried: 0, done: 0, reported: 0 };
    var reach = bots.length ? radius() : 0;
    var places = spread(RUN.robots.map(function (track) {
      return track.length ? [between(track, time, 1), between(track, time, 2)] : [0, 0];
    }), reach);
    var loads = {};
    RUN.tasks.forEach(function (changes, number) {
      var item = items[number], known = changes.length && changes[0][0] <= time;
      var now = known ? changes[before(changes, time)] : null, state = now ? now[1] : "unknown";
      item.setAttribute("class", "item " + state);
      if (now) {
        count[state] += 1;
        if (now[2] >= 0) {
          var at = places[now[2]];
          move(item, at[0] + reach * 1.2, at[1] - reach * 1.2);
          loads[now[2]] = RUN.names[number];
        } else { move(item, now[3], now[4]); }
      }
      if (rows[number]) {
        var team = !now ? "" : state === "awarded" ? now[5].join(" and ") : "";
        if (now && now[2] >= 0) { team = lines[now[2]].childNodes[1].textContent.trim(); }
        rows[number].className = state;
        rows[number].lastChild.textContent = now ? words[state] + team : "is not known yet";
      }
    });
    RUN.does.forEach(function (all, number) {
      var now = all[before(all, time)], load = loads[number];
      bots[number].setAttribute("class", "bot " + now[1]);
      move(bots[number], places[number][0], places[number][1]);
      lines[number].firstChild.className = "disc " + now[1];
      lines[number].lastChild.textContent =
        (now[2] || "rests") +
        (load && now[2].split(": ")[1] !== load ? ", has " + load + " on board" : "");
    });
    return (time / 1000).toFixed(1) + " s: " + count.done + " of " + RUN.tasks.length +
      " tasks done, " + count.carried + " on board, " + count.awarded + " awarded, " +
      count.waits + " waiting" + (count.reported ? ", " + count.reported + " reported" : "");
  });
})();
