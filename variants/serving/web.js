"use strict";
// how far the work for a class is; without this the page is looked at again by its link
const far = document.getElementById("far");
async function look() {
  const state = await (await fetch(far.dataset.state + location.search)).json();
  if (state.over) return location.reload();
  const bar = far.querySelector("progress"), told = far.querySelector("output");
  if (state.whole) { bar.max = state.whole; bar.value = state.done; }
  if (told.textContent !== state.said) told.textContent = state.said;
  setTimeout(look, 500);
}
if (far) look();
// what is answered is told at once, and no form is sent twice
for (const form of document.forms) form.addEventListener("submit", event => {
  if (form.dataset.sent) return event.preventDefault();
  form.dataset.sent = "1";
  form.querySelector("button.main")?.setAttribute("aria-busy", "true");
});
addEventListener("pageshow", () => { for (const form of document.forms) delete form.dataset.sent; });
// on a phone the heads of columns stand in their fields
for (const input of document.querySelectorAll("[data-head]")) input.placeholder = matchMedia("(max-width: 40rem)").matches ? input.dataset.head : "";
// an end of a vector may be anywhere on the picture of its plan; its points are links
const plan = document.getElementById("plan");
if (plan) plan.addEventListener("click", event => {
  if (event.target.closest("a")) return;
  const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(plan.getScreenCTM().inverse());
  location.href = plan.dataset.free.replace("X%2CY", `${at.x.toFixed(2)},${at.y.toFixed(2)}`);
});
