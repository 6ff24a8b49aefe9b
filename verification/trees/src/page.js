for (const section of document.querySelectorAll("section[data-frames]")) {
  const frames = JSON.parse(section.dataset.frames);
  const rows = [...section.querySelectorAll("tr")];
  const items = [...section.querySelectorAll("li")];
  let at = frames.length - 1;
  const show = () => {
    const frame = frames[at];
    rows.forEach((row, node) => {
      const said = frame.answers[node], kept = frame.statuses[node];
      const letter = said !== "-" ? said : kept === "I" ? "" : kept;
      const cell = row.querySelector("td.s");
      cell.textContent = letter;
      cell.className = "s " + letter;
      row.className = said === "-" ? "old" : "";
    });
    items.forEach((item, step) => item.classList.toggle("now", step === at));
    section.querySelector("pre").textContent = frame.blackboard.replaceAll(";", "\n");
  };
  const move = (by) => {
    at = Math.max(0, Math.min(frames.length - 1, at + by));
    show();
  };
  section.querySelector(".back").onclick = () => move(-1);
  section.querySelector(".on").onclick = () => move(1);
  items.forEach((item, step) => { item.onclick = () => { at = step; show(); }; });
  section.addEventListener("keydown", (event) => {
    if (event.key === "ArrowLeft") move(-1);
    else if (event.key === "ArrowRight") move(1);
    else return;
    event.preventDefault();
  });
  show();
}
