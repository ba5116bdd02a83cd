// Shows the method that is chosen: its picture and its error. Arrow keys move among the methods of a scene.
for (const fieldset of document.querySelectorAll("fieldset")) {
  const viewer = fieldset.previousElementSibling;
  const show = ({ target: { dataset } }) => {
    viewer.querySelector(".found").src = dataset.found;
    viewer.querySelector(".error").src = dataset.error;
    viewer.querySelector(".name").textContent = dataset.name;
  };
  fieldset.addEventListener("change", show);
  // a browser may remember an earlier choice
  fieldset.querySelector(":checked")?.dispatchEvent(new Event("change", { bubbles: true }));
}
