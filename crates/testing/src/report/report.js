"use strict";
// The slider uncovers what was expected over what came out; so does a finger or the mouse on the pictures.
for (const input of document.querySelectorAll("figure input[type=range]")) {
    const compare = input.parentElement.querySelector(".compare");
    const uncover = () => compare.style.setProperty("--at", `${input.value}%`);
    const follow = (event) => {
        if (!event.buttons) return;
        const { left, width } = compare.getBoundingClientRect();
        input.value = 100 * (event.clientX - left) / width;
        uncover();
    };
    input.addEventListener("input", uncover);
    compare.addEventListener("pointerdown", (event) => { compare.setPointerCapture(event.pointerId); follow(event); });
    compare.addEventListener("pointermove", follow);
    compare.addEventListener("dragstart", (event) => event.preventDefault());
    uncover();
}

// Of a graph that is wider than the window, the pass whose fault it is.
const guilty = document.querySelector(".card.diverged");
if (guilty) {
    const graph = guilty.closest(".graph");
    graph.scrollLeft = guilty.offsetLeft + guilty.offsetWidth / 2 - graph.clientWidth / 2;
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
    if (!location.hash) return;
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
