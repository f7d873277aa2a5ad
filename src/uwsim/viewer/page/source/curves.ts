// Charts of curves, one below the other, with a cursor at the displayed time.
import uPlot from "uplot";
import type { Samples } from "./player";

const HEIGHT = 96; // height of a chart [px]
const N_OPEN_CHARTS = 8; // number of charts that are unfolded initially
const COLOURS = [ // readable on light and dark, and of different lightness for colour-blind users
  "#2f8fef", "#e8820c", "#1fa367", "#a45ee5", "#e5484d", "#12a5b8", "#b58900", "#d6409f", "#6e7fd9", "#7a8b3a",
];

/** Return the value of the last sample at or before a time [s]; null if there is none, or it has no value. */
export function valueAt(curve: Samples, time: number): number | null {
  let [low, high] = [0, curve.times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (curve.times[middle] <= time + 1e-4) low = middle + 1;
    else high = middle;
  }
  return low === 0 ? null : curve.values[low - 1];
}

interface Chart {
  curve: Samples;
  plot: uPlot;
  cursor: HTMLElement; // the vertical line at the displayed time
  value: HTMLElement; // the value at the displayed time, in the caption
  drawnTime: number | undefined; // time of the last sample that is drawn [s]
}

/** The charts of some curves in an element of the page; a click calls `seek` with the time. */
export class Curves {
  private charts: Chart[] = [];
  private time = 0;

  constructor(
    private readonly container: HTMLElement,
    private readonly seek: (time: number) => void,
  ) {
    this.set([]);
    new ResizeObserver(() => this.resize()).observe(container);
  }

  /** Replace all charts by charts of other curves. */
  set(curves: Samples[]): void {
    for (const { plot } of this.charts) plot.destroy();
    this.container.replaceChildren();
    this.charts = curves.map((curve, i) => this.chart(curve, i));
  }

  /** Draw all charts again, in the colours of the present theme. */
  redraw(): void {
    for (const { plot } of this.charts) plot.redraw(false);
  }

  /** Move the cursors to a time [s], and draw new samples of a running simulation. */
  show(time: number, curves: Samples[]): void {
    this.time = time;
    const isSame = curves.length === this.charts.length && curves.every((curve, i) => curve === this.charts[i].curve);
    if (!isSame) this.set(curves);
    for (const chart of this.charts) {
      const value = valueAt(chart.curve, time);
      chart.value.textContent = valueText(chart.curve, value);
      const lastTime = chart.curve.times.at(-1);
      if (chart.drawnTime !== lastTime) {
        chart.drawnTime = lastTime;
        chart.plot.setData([chart.curve.times, chart.curve.values]);
      }
      this.moveCursor(chart);
    }
  }

  /** Move the cursor of a chart to the displayed time. */
  private moveCursor({ plot, cursor }: Chart): void {
    const x = plot.valToPos(this.time, "x");
    cursor.hidden = !(x >= 0 && x <= plot.over.clientWidth);
    cursor.style.transform = `translateX(${x}px)`;
  }

  /** Make the chart of a curve; `index` is its position on the page, from 0. */
  private chart(curve: Samples, index: number): Chart {
    const figure = document.createElement("figure");
    const caption = document.createElement("figcaption");
    const name = document.createElement("button");
    const value = document.createElement("output");
    name.textContent = curve.name.replaceAll("_", " ");
    name.title = `${curve.name}: fold or unfold`;
    const fold = (isFolded: boolean): void => {
      figure.classList.toggle("folded", isFolded);
      name.setAttribute("aria-expanded", String(!isFolded));
    };
    name.addEventListener("click", () => fold(!figure.classList.contains("folded")));
    fold(index >= N_OPEN_CHARTS);
    name.style.setProperty("--mark", COLOURS[index % COLOURS.length]);
    caption.append(name, value);
    figure.append(caption);
    this.container.append(figure);
    const plot = new uPlot(
      this.options(curve, COLOURS[index % COLOURS.length]), [curve.times, curve.values], figure,
    );
    plot.over.addEventListener("click", (event) => this.seek(plot.posToVal(event.offsetX, "x")));
    const cursor = document.createElement("i");
    cursor.className = "cursor";
    plot.over.append(cursor);
    return { curve, plot, cursor, value, drawnTime: curve.times.at(-1) };
  }

  private options({ names, isFraction }: Samples, colour: string): uPlot.Options {
    const style = (name: string) => getComputedStyle(this.container).getPropertyValue(name).trim();
    const axis = (): uPlot.Axis => ({
      stroke: () => style("--soft"),
      grid: { stroke: () => style("--line"), width: 1 },
      ticks: { show: false },
      font: "10px system-ui, sans-serif",
    });
    return {
      width: Math.max(120, this.container.clientWidth - 20),
      height: HEIGHT,
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      scales: { x: { time: false }, y: { range: rangeOf(names, isFraction) } },
      axes: [
        { ...axis(), size: 20, gap: 2 },
        {
          ...axis(), size: 44, gap: 2, space: 12,
          values: (_, ticks, __, ___, step) => ticks.map((value) => tickText(value, step)),
          ...(names?.length ? { incrs: [1, 2, 5, 10] } : {}),
        },
      ],
      series: [
        {},
        {
          stroke: colour,
          width: 1.5,
          spanGaps: false,
          paths: names?.length ? uPlot.paths.stepped!({ align: 1 }) : undefined,
          points: { show: true, size: 4, fill: colour, filter: isolatedSamples },
        },
      ],
    };
  }

  private resize(): void {
    const width = Math.max(120, this.container.clientWidth - 20);
    for (const chart of this.charts) {
      chart.plot.setSize({ width, height: HEIGHT });
      this.moveCursor(chart);
    }
  }
}

/** Return the limits of the y axis: those of the named values; 0 and 1 for a fraction; else limits around the samples. */
function rangeOf(names?: string[], isFraction?: boolean): uPlot.Range.MinMax | uPlot.Scale.Range {
  if (names?.length) return [0, names.length];
  if (isFraction) return [0, 1];
  return (_, low, high) => {
    if (low === null || high === null) return [0, 1];
    const isFlat = high - low < 1e-5 * Math.max(Math.abs(low), Math.abs(high), 1e-6); // the resolution of float32
    if (isFlat && low >= 0) return [0, high > 0 ? 2 * high : 1];
    const edge = isFlat ? Math.max(0.5, 0.1 * Math.abs(high)) : 0.08 * (high - low);
    return [low - edge, high + edge];
  };
}

/** Return the text of a tick on an axis with the tick spacing `step`. */
function tickText(value: number, step: number): string {
  const digits = [0, 1, 2, 3, 4, 5].find((n) => Math.abs(step * 10 ** n - Math.round(step * 10 ** n)) < 1e-6) ?? 9;
  if (Math.abs(value) >= 1e5 || digits > 5) return value === 0 ? "0" : value.toExponential(1);
  return String(Number(value.toFixed(digits)));
}

/** Return the indices of the samples between two gaps: no line leads to them, so that they are drawn as dots. */
function isolatedSamples(plot: uPlot, series: number): number[] {
  const values = plot.data[series] as (number | null)[];
  const isGap = (i: number): boolean => values[i] === null || values[i] === undefined;
  return [...values.keys()].filter((i) => !isGap(i) && isGap(i - 1) && isGap(i + 1));
}

/** Return a value with its unit, or its name if the values have names. */
function valueText({ unit, names }: Samples, value: number | null): string {
  if (value === null) return "–";
  if (names?.length) return names[value - 1] ?? "none yet";
  return `${number(value)} ${unit === "1" ? "" : unit}`.trim();
}

function number(value: number): string {
  const size = Math.abs(value);
  if (value === 0) return "0";
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toPrecision(4);
}
