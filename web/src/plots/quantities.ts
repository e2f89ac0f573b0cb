import type { Report } from "../report";
import { type Series, seriesOf } from "./series";

/** What can be plotted over anything else, under a title; `first` counts the quantities before it. */
export interface Group {
  title: string;
  first: number;
  series: Series[];
}

/** All curves of the plots, and where the points of the model are. */
export function quantities({ data, motion }: Report): Group[] {
  const groups = data.plots.map((plot) => ({ title: plot.title, series: seriesOf(plot) }));
  const { unit, size } = data.units.m;
  const places = data.scene.points
    .filter(({ figure }) => figure)
    .flatMap(({ name, figure, at }) => {
      const path = motion.path(figure, at);
      return ["x", "y"].map((axis, k) => ({ name: `${axis} of ${name}`, unit, t: data.scene.t, y: Float32Array.from(path, (place) => place[k] / size) }));
    });
  const made: Group[] = [];
  let first = 0;
  for (const group of places.length ? [...groups, { title: "Places", series: places }] : groups) {
    made.push({ ...group, first });
    first += group.series.length;
  }
  return made;
}
