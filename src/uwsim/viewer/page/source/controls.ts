// The interface of the page that its keys, its toolbar and the live link use.
import type { Reading } from "./display/quantities";
import type { Pack } from "./pack";
import type { Picture, Switches } from "./picture";
import type { Player } from "./player";
import type { Mode, Views } from "./views";

/** The parts of the view that may be shown or hidden. */
export type Switch = "clear" | "state" | "pictures" | "frames" | "trails" | "sonars" | "labels";

/** The interface of a running simulation that the keys use. */
export interface LiveControls {
  /** True if the simulation allows a reset to its initial state. */
  readonly allowsReset: boolean;
  readonly pilot: { isReserved(key: string): boolean };
  takeKey(event: KeyboardEvent): boolean;
  helpGroups(): Record<string, { keys: string; action: string }[]>;
}

export interface Controls {
  readonly time: number;
  isPlaying: boolean;
  readonly switches: Switches;
  readonly pack: Pack;
  readonly player: Player;
  readonly picture: Picture;
  readonly views: Views;
  readonly link: LiveControls | null;
  readonly quantities: { setReadings(readings: Reading[]): boolean };
  readonly keyboard: { showHelp(): void };
  go(index: number): Promise<void>;
  seek(time: number): void;
  play(isOn?: boolean): void;
  step(direction: number): void;
  reset(): void;
  changeSpeed(direction: number): void;
  setState(isPaused: boolean, speed: number): void;
  show(mode: Mode): void;
  toggle(name: Switch): void;
  clearTrails(): void;
  theme(): void;
  draw(): void;
  refresh(): void;
}
