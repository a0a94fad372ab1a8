// Before anything of the page: what goes wrong is remembered.
window.problems = [];
addEventListener("error", (event) => problems.push(String(event.message)));
addEventListener("unhandledrejection", (event) => problems.push(String(event.reason)));
addEventListener("securitypolicyviolation", (event) => problems.push(`${event.violatedDirective} ${event.blockedURI}`));
console.error = console.warn = (...words) => problems.push(words.join(" "));
// In virtual time hardly a frame is asked for; timers come as they should.
window.requestAnimationFrame = (draw) => setTimeout(() => draw(performance.now()), 16);
