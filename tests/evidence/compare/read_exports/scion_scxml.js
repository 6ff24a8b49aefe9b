#!/usr/bin/env node
// Runs the exported state charts in SCION, an interpreter of W3C SCXML, beside the token game.
//
//     npm install --prefix DIR @scion-scxml/scxml@4.3.27
//     NODE_PATH=DIR/node_modules node tests/evidence/compare/read_exports/scion_scxml.js [RUNS]
//
// For each `NAME.scxml` of the golden exports, 200 random events and waits go to the chart and to a
// token game with time on `NAME.json`, in each of RUNS (30) runs; state, variables and outputs have
// to be the same after every step. The clock is a simulated one. What the chart leaves to its
// environment, the intervals that it lists as not kept, is left to this script: it offers an event
// only within its interval, and sends the timeouts.
//
// Exit status: 0 when all agree, 1 when one differs, 77 when SCION is not installed.
'use strict';
const fs = require('fs');
const path = require('path');

let scxml;
try {
  scxml = require('@scion-scxml/scxml');
} catch (error) {
  console.error('SKIPPED: @scion-scxml/scxml is not installed; see the head of this script');
  process.exit(77);
}
const GOLDEN = path.resolve(__dirname, '../../../../verification/tests/golden/exports');
const STEPS = 200;
const RUNS = Number(process.argv[2] || 30);

// Numerical Recipes' linear congruential generator: a whole number below `limit`.
function generator(state) {
  return (limit) => {
    state = (Math.imul(state, 1664525) + 1013904223) >>> 0;
    return Math.floor((state / 2 ** 32) * limit);
  };
}

// Timers of a simulated clock, in place of the platform's.
class Clock {
  constructor() { this.now = 0; this.timers = []; this.count = 0; }
  set(call, delay) {
    const timer = { call, at: this.now + Number(delay || 0), number: this.count++ };
    this.timers.push(timer);
    return timer;
  }
  clear(timer) { this.timers = this.timers.filter((it) => it !== timer); }
  advance(to) {
    for (;;) {
      const due = this.timers
        .filter((it) => it.at <= to)
        .sort((a, b) => a.at - b.at || a.number - b.number)[0];
      if (!due) break;
      this.clear(due);
      this.now = due.at;
      due.call();
    }
    this.now = to;
  }
}

// A net as it is played: highest priority first, then the earlier one; clocks as of a time Petri
// net.
class Tokens {
  constructor(net) {
    this.net = net;
    this.marking = new Map(net.places.map((it) => [it.name, it.initial]));
    this.order = net.transitions.map((it, at) => ({ ...it, at }));
    this.order.sort((a, b) => b.priority - a.priority || a.at - b.at);
    this.now = 0;
    this.outputs = [];
    this.fired = new Set();
    this.since = new Map(this.order.filter((it) => this.enabled(it)).map((it) => [it.name, 0]));
    this.settle();
  }
  enabled(it, marking = this.marking) {
    return [...it.take, ...it.read].every((arc) => marking.get(arc.place) >= arc.weight);
  }
  fire(it) {
    const between = new Map(this.marking);
    it.take.forEach((arc) => between.set(arc.place, between.get(arc.place) - arc.weight));
    this.marking = new Map(between);
    it.give.forEach((arc) => this.marking.set(arc.place, this.marking.get(arc.place) + arc.weight));
    for (const other of this.order) {
      if (!this.enabled(other)) this.since.delete(other.name);
      else if (
        other.name === it.name || !this.enabled(other, between) || !this.since.has(other.name)
      ) {
        this.since.set(other.name, this.now);
      }
    }
    this.outputs.push(...it.emits);
    this.fired.add(it.name);
  }
  settle() {
    const free = (it) => it.on === null && !it.within && this.enabled(it);
    for (let it; (it = this.order.find(free)); ) this.fire(it);
  }
  // The transition that is due first by itself, and when. Of two at the same instant the one whose
  // clock started first: the documented rule of the chart, where the net would look at priorities.
  due() {
    const timed = this.order.filter((it) => it.on === null && it.within && this.enabled(it));
    const since = (it) => this.since.get(it.name);
    const at = (it) => since(it) + it.within.earliest;
    return timed
      .map((it) => ({ at: at(it), it }))
      .sort((a, b) => a.at - b.at || since(a.it) - since(b.it))[0];
  }
  // Whether the event means the same with and without its interval.
  open(event) {
    const waits = (it) => it.on === event && it.within && this.enabled(it);
    return this.order.filter(waits).every((it) => {
      const elapsed = this.now - this.since.get(it.name);
      const { earliest, latest } = it.within;
      return earliest <= elapsed && (latest === null || elapsed <= latest);
    });
  }
  offer(event) {
    const it = this.order.find((it) => it.on === event && this.enabled(it));
    if (it) this.fire(it);
    this.settle();
  }
}

// Enough for the names of these nets.
const written = (name) => name.replace(/[^A-Za-z0-9_-]/g, '_');

// One run; the names of the transitions that fired.
function compare(file, factory, net, text, seed) {
  const clock = new Clock();
  global.setTimeout = (call, delay) => clock.set(call, delay);
  global.clearTimeout = (timer) => clock.clear(timer);
  const outputs = [];
  const parentSession = { gen: (event) => outputs.push(event.name) };
  const chart = new scxml.core.Statechart(factory, { parentSession });
  const unkept = (/no timer of this chart keeps: (.*)\. -->/.exec(text) || [, ''])[1].split(', ');
  const tokens = new Tokens(net);
  const random = generator(seed);
  const variables = net.places.filter((it) => it.role === 'data');

  const check = (step, what) => {
    const state = net.places.filter((it) => it.role === 'state' && tokens.marking.get(it.name) > 0);
    const ours = [
      written(state[0].name),
      ...variables.map((it) => tokens.marking.get(it.name)),
      ...tokens.outputs.map(written),
    ];
    const data = chart.getSnapshot()[3];
    const theirs = [
      ...chart.getConfiguration(),
      ...variables.map((it) => Number(data[written(it.name)])),
      ...outputs,
    ];
    if (JSON.stringify(ours) !== JSON.stringify(theirs)) {
      const where = `${file}, run ${seed}, step ${step} (${what})`;
      throw new Error(`${where}: the net is at ${ours}, the chart at ${theirs}`);
    }
    tokens.outputs.length = outputs.length = 0;
  };
  const wait = (time) => {
    const end = tokens.now + time;
    for (let next; (next = tokens.due()) && next.at <= end; ) {
      tokens.now = next.at;
      tokens.fire(next.it);
      tokens.settle();
      clock.advance(next.at);
      if (unkept.includes(next.it.name)) chart.gen({ name: `timeout_${written(next.it.name)}` });
    }
    tokens.now = end;
    clock.advance(end);
  };

  chart.start();
  clock.advance(0);
  check(0, 'start');
  for (let step = 1; step <= STEPS; step++) {
    const choice = random(net.events.length + 1);
    let what;
    if (choice < net.events.length && tokens.open(net.events[choice].name)) {
      what = net.events[choice].name;
      tokens.offer(what);
      chart.gen({ name: written(what) });
      clock.advance(tokens.now);
    } else {
      const next = tokens.due();
      // Up to the very instant of the next firing, one millisecond less, or any time.
      const short = random(8);
      what = next && short < 2 ? Math.max(0, next.at - tokens.now - short) : 1 + random(4000);
      wait(what);
    }
    check(step, what);
  }
  return tokens.fired;
}

const real = { setTimeout: global.setTimeout, clearTimeout: global.clearTimeout };
const { promisify } = require('util');

async function main() {
  for (const file of ['door.scxml', 'light.scxml', 'choice.scxml']) {
    const source = path.join(GOLDEN, file);
    const net = JSON.parse(fs.readFileSync(source.replace(/scxml$/, 'json'), 'utf8'));
    // Without events and time each transition waits for an event of its name.
    if (!net.events.length && net.transitions.every((it) => !it.within)) {
      net.events = net.transitions.map((it) => ({ name: it.name }));
      net.transitions.forEach((it) => { it.on = it.name; });
    }
    const model = await promisify(scxml.pathToModel)(source);
    const fired = new Set();
    for (let seed = 1; seed <= RUNS; seed++) {
      // Variables belong to it: one for each run.
      const factory = await promisify(model.prepare.bind(model))();
      const text = fs.readFileSync(source, 'utf8');
      compare(file, factory, net, text, seed).forEach((it) => fired.add(it));
      Object.assign(global, real);
    }
    const all = net.transitions.length;
    const runs = `${RUNS} runs of ${STEPS} steps agree`;
    console.log(`${file}: ${runs}, ${fired.size} of ${all} transitions fired`);
    if (fired.size < all) throw new Error('a transition that never fires is not compared');
  }
}
main().catch((error) => {
  console.error(error.message || error);
  process.exitCode = 1;
});
