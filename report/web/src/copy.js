// Buttons with data-copy copy that text to the clipboard.
import { announce } from "./dom.js";

async function copy(text) {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    // no permission, or an old browser: copies a selection instead
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

export function watchCopyButtons() {
  document.addEventListener("click", async (event) => {
    const button = event.target.closest("[data-copy]");
    if (!button) return;
    const before = button.textContent;
    const done = await copy(button.dataset.copy);
    button.focus();
    button.textContent = done ? "copied" : "not copied";
    announce(button.textContent);
    setTimeout(() => {
      button.textContent = before;
    }, 1500);
  });
}
