// The interface of the page for tests and for the browser's console.
import type { Controls } from "./controls";
import { valueAt } from "./curves";
import { matrix } from "./geometry";
import { findParticles } from "./water/particles";
import { indexAt } from "./panels";

/** Set `window.uwsim` to the interface of the page. */
export function exposeToConsole(page: Controls): void {
  const { player, picture } = page;
  Object.assign(window, {
    uwsim: {
      page,
      seek: (time: number) => page.seek(time),
      go: (index: number) => page.go(index),
      time: () => page.time,
      level: () => indexAt(player, page.time),
      /** The value of each measure at the displayed time, by the measure's name. */
      curves: () => Object.fromEntries(player.curves.map((c) => [c.name, valueAt(c, page.time)])),
      /** The pose of a body in W as a 4 x 4 matrix, row by row. */
      body: (name: string) => Array.from(picture.models.body(name)),
      /** The markers at the displayed time. */
      markers: () => player.markers(page.time),
      /** The heights of the columns of a heap of sand [m]. */
      sand: (index: number) => Array.from(picture.models.heights(index)),
      /** The puffs of sediment at the displayed time. */
      puffs: () => player.puffs(page.time)?.puffs ?? [],
      /** The records of the particles in the image of a camera. */
      particles: (name: string) => {
        const { cameras, particles, water } = page.pack.head;
        const camera = cameras.find((candidate) => candidate.name === name)!;
        const snapshot = player.snapshot(page.time);
        picture.models.place(snapshot.poses);
        const worldFromCamera = picture.models.worldFromMount(camera);
        return Array.from(findParticles(particles!, snapshot.drift(), worldFromCamera, camera, water.surface_height));
      },
      /** The image of a camera in the camera's resolution: RGBA, row 0 at the top, as base64. */
      image: (name: string, water = {}) => {
        const camera = page.pack.head.cameras.find((candidate) => candidate.name === name)!;
        const snapshot = player.snapshot(page.time);
        picture.models.place(snapshot.poses);
        const worldFromCamera = picture.models.worldFromMount(camera);
        const settings = { grey: camera.grey, water };
        return encode(picture.image(camera, worldFromCamera, player, snapshot, page.switches, settings));
      },
      /** The image of an external view with the intrinsics of the first camera, as that of a camera. */
      external: (worldFromCamera: number[], isClear: boolean) => {
        const [camera] = page.pack.head.cameras;
        const settings = { isExternal: true, isClear };
        const snapshot = player.snapshot(page.time);
        return encode(picture.image(camera, matrix(worldFromCamera), player, snapshot, page.switches, settings));
      },
    },
  });
}

/** Return bytes as base64. */
function encode(bytes: Uint8Array): string {
  let text = "";
  for (let i = 0; i < bytes.length; i += 8192) text += String.fromCharCode(...bytes.subarray(i, i + 8192));
  return btoa(text);
}
