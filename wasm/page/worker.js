// The worker of a page: its first message is the core and the machines, later ones are for the session.

import { initSync, Simulation } from "./drumrs.js";
import { Session } from "./session.js";

let session = null;
onmessage = ({ data }) => {
  if (session) {
    session.hear(data);
    return;
  }
  initSync({ module: data.core });
  session = new Session(Simulation, data.machines, (told) => postMessage(told));
  postMessage({ kind: "open" });
};
