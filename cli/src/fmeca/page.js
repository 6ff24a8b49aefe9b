// Sorts and filters the rows of the table. Without it the page shows all rows as they are written.
(function () {
  "use strict";
  var pick = document.getElementById("pick");
  var body = document.querySelector("#table tbody");
  var rows = Array.prototype.slice.call(body.rows);
  var texts = rows.map(function (row) { return row.textContent.toLowerCase(); });
  function show() {
    var words = pick.elements.words.value.toLowerCase().split(/\s+/);
    var key = "data-" + pick.elements.order.value;
    var shown = 0;
    rows.forEach(function (row, at) {
      var has = words.every(function (word) { return texts[at].indexOf(word) !== -1; });
      row.hidden = !has || ["severity", "class"].some(function (name) {
        return Number(row.getAttribute("data-" + name)) > 4 - Number(pick.elements[name].value);
      });
      shown += row.hidden ? 0 : 1;
    });
    rows.slice().sort(function (a, b) {
      return Number(a.getAttribute(key)) - Number(b.getAttribute(key));
    }).forEach(function (row) { body.appendChild(row); });
    pick.querySelector("output").textContent = shown + " of " + rows.length;
  }
  // A link to a row that is filtered away shows it.
  window.addEventListener("hashchange", function () {
    var row = document.getElementById(location.hash.slice(1));
    if (row && row.hidden) { pick.reset(); show(); row.scrollIntoView(); }
  });
  pick.addEventListener("input", show);
  pick.addEventListener("submit", function (event) { event.preventDefault(); });
  pick.hidden = false;
  show();
}());
