// Links that the theme and the gallery leave without a name; screen readers need one.
document.addEventListener("DOMContentLoaded", () => {
  for (const arrow of document.querySelectorAll("summary:has(.toctree-toggle)")) {
    const page = arrow.closest("li")?.querySelector("a")?.textContent ?? "this page";
    arrow.setAttribute("aria-label", `Pages below ${page.trim()}`);
  }
  for (const link of document.querySelectorAll(".sphx-glr-thumbcontainer a")) {
    link.setAttribute("aria-label", link.textContent.trim());
  }
});
