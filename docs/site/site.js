// The theme's arrows that unfold a page's children have no name; screen readers need one.
document.addEventListener("DOMContentLoaded", () => {
  for (const arrow of document.querySelectorAll("summary:has(.toctree-toggle)")) {
    const page = arrow.closest("li")?.querySelector("a")?.textContent ?? "this page";
    arrow.setAttribute("aria-label", `Pages below ${page.trim()}`);
  }
});
