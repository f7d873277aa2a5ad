// The interface of the page that its keys, its toolbar and the connection to a running simulation use.
import type { Reading } from "./display/quantities";
import type { Pack } from "./pack";
import type { Picture, Switches } from "./picture";
import type { Player } from "./player";
import type { Mode, Views } from "./views";

/** The settings of the view that have a button or a key; the interface `Switches` describes them. */
export type Switch = "clear" | "state" | "pictures" | "frames" | "trails" | "sonars" | "labels";

/** The interface of the connection to a running simulation that the keys use. */
export interface LiveControls {
  /** True if the simulation allows a reset to its initial state. */
  readonly allowsReset: boolean;
  readonly pilot: { isReserved(key: string): boolean };
  /** Apply a key of the pilot; return false if the key is not the pilot's. */
  handlePilotKey(event: KeyboardEvent): boolean;
  /** Return the lines of the help for the pilot's keys, below their title. */
  helpGroups(): Record<string, { keys: string; action: string }[]>;
}

/** The interface of the page. */
export interface Controls {
  /** The displayed simulation time [s]. */
  readonly time: number;
  isPlaying: boolean;
  readonly switches: Switches;
  readonly pack: Pack;
  readonly player: Player;
  readonly picture: Picture;
  readonly views: Views;
  /** The connection to the running simulation; null in a replay. */
  readonly connection: LiveControls | null;
  readonly quantities: { setReadings(readings: Reading[]): boolean };
  readonly keyboard: { showHelp(): void };
  /** Go to the beginning of the level with an index. */
  go(index: number): Promise<void>;
  /** Show a simulation time [s] of a replay. */
  seek(time: number): void;
  /** Play or pause; without an argument, change from one to the other. */
  play(isOn?: boolean): void;
  /** Pause, and go one frame of 1/30 s forward (1) or back (-1); a live simulation executes one step. */
  step(direction: number): void;
  /** Reset the simulation, or go to the beginning of the level. */
  reset(): void;
  /** Select the next higher (1) or lower (-1) real-time factor. */
  changeSpeed(direction: number): void;
  /** Show whether the running simulation is paused, and its real-time factor (0: no limit). */
  setState(isPaused: boolean, speed: number): void;
  /** Select a view; if the view is that of a camera already, the next camera. */
  show(mode: Mode): void;
  toggle(name: Switch): void;
  /** Begin all trails at the displayed time. */
  clearTrails(): void;
  /** Change between light and dark colours. */
  toggleTheme(): void;
  /** Draw the page at the displayed time. */
  draw(): void;
  /** Draw the page after a change of its settings. */
  refresh(): void;
}
