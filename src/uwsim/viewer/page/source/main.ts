// The entry point of the page: it shows the replay that the page contains, or a live view.
import { reloadAfterContextLoss } from "./drawing/recovery";
import { connect } from "./live";
import { decodeBase85, unpack } from "./pack";
import { Page } from "./page";
import { element } from "./panels";
import { graphics, Picture } from "./picture";
import { Replay, type Player } from "./player";
import { Stream } from "./players/stream";
import { Rays } from "./display/rays";
import { exposeToConsole } from "./testing";
import { Views } from "./views";

const NO_GRAPHICS =
  "This browser does not support WebGL 2: the page shows no 3-D view, only the results (levels and curves).";
const NO_FLOATS =
  "This browser cannot draw into floating-point textures: the page shows the fog of the scene, not its physical water.";

async function begin(): Promise<void> {
  const isDark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = isDark ? "dark" : "light";
  const message = element("message");
  message.textContent = "Loading…";
  const canvas = element<HTMLCanvasElement>("image");
  reloadAfterContextLoss(canvas, (text) => (message.textContent = text));
  const gl = graphics(canvas);
  try {
    const data = document.getElementById("pack");
    const isServerDrawn = gl === null; // without WebGL, the server of a live view draws it
    const connection = data ? null : await connect(isServerDrawn);
    const pack = connection ? connection.pack : await unpack(decodeBase85(data!.textContent ?? ""));
    const picture = await Picture.make(gl, pack);
    const player: Player = connection ? new Stream(pack.head) : new Replay(pack);
    const rays = new Rays(pack);
    const page = new Page(pack, player, picture, new Views(pack.head, picture.models, rays), connection, rays);
    page.note = gl || connection ? "" : NO_GRAPHICS;
    if (picture.lacksFloats) page.note = NO_FLOATS;
    message.textContent = page.note;
    connection?.begin(page, player as Stream);
    const levelIndex = Number(new URLSearchParams(location.hash.slice(1)).get("level") ?? 0);
    if (!connection) {
      await page.select(player.levels[levelIndex]?.trial ?? 0);
      page.seek(player.levels[levelIndex] ? player.levels[levelIndex].level.start : player.start);
    }
    exposeToConsole(page);
  } catch (error) {
    if (gl?.isContextLost()) return; // the message says so
    message.textContent = error instanceof Error ? error.message : String(error);
    throw error;
  }
}

void begin();
