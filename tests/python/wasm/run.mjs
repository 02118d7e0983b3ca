// node run.mjs FOLDER < CASES: runs cases with the core in WebAssembly that is in a folder.
//
// A case is { config, seed, steps, then }: `then` is { config, steps } or null, another configuration to go on with. Told is, for
// each, the SHA-256 of the bytes of positions, velocities, angles and the last sample, and steps in a second of the CPU.

import { createHash } from "node:crypto";
import { readFileSync } from "node:fs";
import { join, resolve } from "node:path";

// Node would tell where in the module by quoting all of it.
process.on("uncaughtException", ({ message }) => {
  process.stderr.write(message);
  process.exit(1);
});

const folder = resolve(process.argv[2]);
const text = readFileSync(join(folder, "drumrs.js"));
// A data URL, for a file named .js in a folder without a package is no module to node.
const { initSync, Simulation } = await import(`data:text/javascript;base64,${text.toString("base64")}`);
initSync({ module: readFileSync(join(folder, "drumrs_bg.wasm")) });

const digest = (array) => createHash("sha256").update(new Uint8Array(array.buffer)).digest("hex");

const told = JSON.parse(readFileSync(0, "utf8")).map(({ config, seed, steps, then }) => {
  const simulation = new Simulation(config, seed);
  const start = process.cpuUsage();
  simulation.run(steps);
  const { user, system } = process.cpuUsage(start);
  if (then) {
    simulation.change(then.config);
    simulation.run(then.steps);
  }
  const names = ["positions", "velocities", "angles", "last_sample"];
  return { ...Object.fromEntries(names.map((name) => [name, digest(simulation[name]())])), columns: simulation.columns(), time: simulation.time, speed: (1e6 * steps) / (user + system) };
});
process.stdout.write(JSON.stringify(told));
