// Dark or light: follows the system until the switch is used.
import { h } from "./dom.js";

export function themeSwitch() {
  const system = matchMedia("(prefers-color-scheme: dark)");
  const isDark = () =>
    (document.documentElement.dataset.theme ?? (system.matches ? "dark" : "light")) === "dark";
  const button = h("button", {
    type: "button",
    class: "theme",
    onclick: () => {
      document.documentElement.dataset.theme = isDark() ? "light" : "dark";
      say();
    },
  });
  const say = () => {
    button.textContent = isDark() ? "☀ light" : "☾ dark";
    button.setAttribute("aria-label", isDark() ? "Use light colours" : "Use dark colours");
  };
  system.addEventListener("change", say);
  say();
  return button;
}
