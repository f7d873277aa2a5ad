// Curves of all measures, with the cursor where the time is.
import uPlot from "uplot";
import type { Samples } from "./player";

const HEIGHT = 96;
const COLOURS = ["#3b9eff", "#ff9f43", "#2fc47f", "#c678ff", "#ff6b81", "#22c3cf"];

/** The value of the last sample at or before a time; null: nothing was measured. */
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
  cursor: HTMLElement;
  value: HTMLElement;
  drawn: number;
}

export class Curves {
  private charts: Chart[] = [];
  private time = 0;

  constructor(
    private readonly place: HTMLElement,
    private readonly seek: (time: number) => void,
  ) {
    this.set([]);
    new ResizeObserver(() => this.resize()).observe(place);
  }

  set(curves: Samples[]): void {
    for (const { plot } of this.charts) plot.destroy();
    this.place.replaceChildren();
    this.charts = curves.map((curve, i) => this.chart(curve, i));
    if (curves.length) return;
    const none = document.createElement("p");
    none.className = "none";
    none.textContent = "No measure has a log.";
    this.place.append(none);
  }

  /** Draw all charts again, in the colours of now. */
  redraw(): void {
    for (const { plot } of this.charts) plot.redraw(false);
  }

  /** Move the cursor; new samples of a live run are drawn, too. */
  show(time: number, curves: Samples[]): void {
    this.time = time;
    if (curves.length !== this.charts.length) this.set(curves);
    for (const chart of this.charts) {
      const value = valueAt(chart.curve, time);
      chart.value.textContent = value === null ? "–" : `${number(value)} ${chart.curve.unit}`;
      if (chart.drawn !== chart.curve.times.length) {
        chart.drawn = chart.curve.times.length;
        chart.plot.setData([chart.curve.times, chart.curve.values]);
      }
      this.point(chart);
    }
  }

  /** Put the cursor of a chart where the time is. */
  private point({ plot, cursor }: Chart): void {
    const x = plot.valToPos(this.time, "x");
    cursor.hidden = !(x >= 0 && x <= plot.over.clientWidth);
    cursor.style.transform = `translateX(${x}px)`;
  }

  private chart(curve: Samples, number: number): Chart {
    const figure = document.createElement("figure");
    const caption = document.createElement("figcaption");
    const name = document.createElement("span");
    const value = document.createElement("output");
    name.textContent = curve.name;
    name.style.setProperty("--mark", COLOURS[number % COLOURS.length]);
    caption.append(name, value);
    figure.append(caption);
    this.place.append(figure);
    const plot = new uPlot(
      this.options(COLOURS[number % COLOURS.length]), [curve.times, curve.values], figure,
    );
    plot.over.addEventListener("click", (event) => this.seek(plot.posToVal(event.offsetX, "x")));
    const cursor = document.createElement("i");
    cursor.className = "cursor";
    plot.over.append(cursor);
    return { curve, plot, cursor, value, drawn: curve.times.length };
  }

  private options(colour: string): uPlot.Options {
    const style = (name: string) => getComputedStyle(this.place).getPropertyValue(name).trim();
    const axis = (): uPlot.Axis => ({
      stroke: () => style("--soft"),
      grid: { stroke: () => style("--line"), width: 1 },
      ticks: { show: false },
      font: "10px system-ui, sans-serif",
    });
    return {
      width: Math.max(120, this.place.clientWidth - 20),
      height: HEIGHT,
      legend: { show: false },
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      scales: { x: { time: false } },
      axes: [{ ...axis(), size: 20, gap: 2 }, { ...axis(), size: 44, gap: 2, space: 12 }],
      series: [{}, { stroke: colour, width: 1.5, points: { show: false }, spanGaps: false }],
    };
  }

  private resize(): void {
    const width = Math.max(120, this.place.clientWidth - 20);
    for (const chart of this.charts) {
      chart.plot.setSize({ width, height: HEIGHT });
      this.point(chart);
    }
  }
}

function number(value: number): string {
  const size = Math.abs(value);
  if (value === 0) return "0";
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toPrecision(4);
}
