// A button to copy what is meant to be copied.
for (const text of document.querySelectorAll("pre.copy")) {
  const holder = document.createElement("div");
  const button = document.createElement("button");
  holder.className = "held";
  button.type = "button";
  button.textContent = "copy";
  text.replaceWith(holder);
  holder.append(text, button);
  button.addEventListener("click", async () => {
    try {
      await navigator.clipboard.writeText(text.textContent);
      button.textContent = "copied";
    } catch {
      // Without a right to the clipboard, at least it is selected.
      getSelection().selectAllChildren(text);
      button.textContent = "selected";
    }
    setTimeout(() => { button.textContent = "copy"; }, 1500);
  });
}
