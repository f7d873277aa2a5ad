// Recovery from a lost WebGL context: when the browser's graphics process ends, everything on it is gone.
const RELOADS = "uwsim.reloads"; // the key of the times of the reloads in the storage of the tab
const MAX_RELOADS = 3; // within RELOAD_WINDOW; a page that ends the process each time it is drawn must not go on
const RELOAD_WINDOW = 60_000; // [ms]
const RESTORE_TIME = 3000; // the time that the browser gets to restore a context before the page begins again [ms]
const LOST = "The browser's graphics process has ended. The page begins again.";
const LOST_AGAIN = "The browser's graphics process ends again and again. Reload the page to try once more.";

/** Load the page again after its context was lost: when the browser has restored it, or after a time. */
export function reloadAfterContextLoss(canvas: HTMLCanvasElement, say: (text: string) => void): void {
  let hasBegun = false;
  const begin = () => {
    if (!hasBegun) location.reload();
    hasBegun = true;
  };
  canvas.addEventListener("webglcontextlost", (event) => {
    event.preventDefault(); // the browser restores only contexts that a page wants back
    if (!countReload(Date.now())) return say(LOST_AGAIN);
    say(LOST);
    canvas.addEventListener("webglcontextrestored", begin);
    setTimeout(begin, RESTORE_TIME); // some losses are not followed by the event
  });
}

/** Add a reload to the list of recent ones; return false if there were too many. */
function countReload(now: number): boolean {
  const text = sessionStorage.getItem(RELOADS) ?? "";
  const times = text.split(" ").map(Number).filter((time) => time > now - RELOAD_WINDOW);
  if (times.length >= MAX_RELOADS) return false;
  sessionStorage.setItem(RELOADS, [...times, now].join(" "));
  return true;
}
