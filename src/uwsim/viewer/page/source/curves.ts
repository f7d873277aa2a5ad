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
      } else chart.plot.redraw(false, false);
    }
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
    return { curve, plot, value, drawn: curve.times.length };
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
      axes: [{ ...axis(), size: 20, gap: 2 }, { ...axis(), size: 44, gap: 2 }],
      series: [{}, { stroke: colour, width: 1.5, points: { show: false }, spanGaps: false }],
      hooks: {
        draw: [
          (plot) => {
            const x = Math.round(plot.valToPos(this.time, "x", true)) + 0.5;
            const { left, top, width, height } = plot.bbox;
            if (x < left || x > left + width) return;
            plot.ctx.strokeStyle = style("--accent");
            plot.ctx.lineWidth = 1.5;
            plot.ctx.beginPath();
            plot.ctx.moveTo(x, top);
            plot.ctx.lineTo(x, top + height);
            plot.ctx.stroke();
          },
        ],
      },
    };
  }

  private resize(): void {
    const width = Math.max(120, this.place.clientWidth - 20);
    for (const { plot } of this.charts) plot.setSize({ width, height: HEIGHT });
  }
}

function number(value: number): string {
  const size = Math.abs(value);
  if (value === 0) return "0";
  return size >= 1e5 || size < 1e-3 ? value.toExponential(2) : value.toPrecision(4);
}
