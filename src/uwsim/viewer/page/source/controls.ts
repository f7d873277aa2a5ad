// The page as its keys, its buttons and a running simulation see it.
import type { Reading } from "./display/quantities";
import type { Pack } from "./pack";
import type { Picture, Switches } from "./picture";
import type { Player } from "./player";
import type { Mode, Views } from "./views";

/** What may be shown or hidden. */
export type Switch = "clear" | "state" | "pictures" | "frames" | "trails" | "sonars" | "labels";

/** A running simulation, as far as the keys are its pilot's. */
export interface Piloted {
  /** Whether all may go back where it began. */
  readonly resets: boolean;
  readonly pilot: { has(key: string): boolean };
  takes(event: KeyboardEvent): boolean;
  help(): Record<string, { keys: string; does: string }[]>;
}

export interface Controls {
  readonly time: number;
  isPlaying: boolean;
  readonly switches: Switches;
  readonly pack: Pack;
  readonly player: Player;
  readonly picture: Picture;
  readonly views: Views;
  readonly link: Piloted | null;
  readonly quantities: { hear(readings: Reading[]): boolean };
  readonly keyboard: { help(): void };
  go(index: number): Promise<void>;
  seek(time: number): void;
  play(on?: boolean): void;
  step(direction: number): void;
  reset(): void;
  faster(direction: number): void;
  isTold(paused: boolean, speed: number): void;
  show(mode: Mode): void;
  toggle(name: Switch): void;
  clearTrails(): void;
  theme(): void;
  draw(): void;
  refresh(): void;
}
