"use strict";
// The slider uncovers what was expected over what came out.
for (const input of document.querySelectorAll("figure input[type=range]")) {
    const over = input.parentElement.querySelector(".over");
    const uncover = () => { over.style.clipPath = `inset(0 ${100 - input.value}% 0 0)`; };
    input.addEventListener("input", uncover);
    uncover();
}

const ports = [...document.querySelectorAll("details.port")];
let at = -1;

// Opens a port and brings it into view, with the slider ready for the arrow keys.
function show(index) {
    if (index < 0 || index >= ports.length) return;
    at = index;
    ports[at].open = true;
    ports[at].scrollIntoView({ block: "start" });
    (ports[at].querySelector("input[type=range]") ?? ports[at].querySelector("summary")).focus({ preventScroll: true });
}

function open_target() {
    const index = ports.findIndex((port) => port.id === decodeURIComponent(location.hash.slice(1)));
    if (index >= 0) show(index);
}
addEventListener("hashchange", open_target);
open_target();

addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "j") show(at + 1);
    if (event.key === "k") show(at - 1);
    if (event.key === "t") {
        const root = document.documentElement;
        const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
        root.dataset.theme = dark ? "light" : "dark";
    }
});
