// The beginning, and what is said where there is none.

function broken(error) {
  const it = byId("broken");
  it.textContent = `This page cannot be played: ${error.message}.`;
  it.hidden = false;
}

async function main() {
  const data = JSON.parse(byId("data").textContent);
  const period = data.robot || data.mail ? PERIOD : 0;
  const play = data.robot
    ? new RobotPlay(data, await RobotEngine.with(data), period)
    : new Play(data, await Engine.of(data.module, data.model, period), period);
  byId("controls").hidden = false;
  play.show();
  play.say(data.robot
    ? "Say that the mission begins; then let something fail."
    : "Tell it an event: in the list, or in a drawing.");
  if (data.outing) {
    play.outing = new Outing(play);
    if (data.outing.items.length > 0) {
      play.say("Move a fault along the axis: what comes of it follows at once.");
    }
  }
  if (location.hash.length > 1) {
    await play.attempt(() => play.follow());
  }
  document.documentElement.dataset.ready = String(Math.round(performance.now()));
}

main().catch(broken);
