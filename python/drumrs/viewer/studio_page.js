// The page of `drumrs studio`: a studio that is alone there, and so takes all keys.

import { Live } from "./live.js";
import { Studio } from "./studio.js";

const address = new URL(`session${location.search}`, location.href);
address.protocol = "ws:";
const studio = new Studio(document.querySelector("main"), new Live(address));
document.addEventListener("keydown", (event) => event.target === document.body && studio.press(event));
Object.assign(window, { studio });
