// The mesh of the water's surface, and the part of it that a camera sees, as in uwsim.rendering.surface.surface_mesh.
import { ATTRIBUTES } from "../../drawing/shaders";
import { rotate, type Intrinsics, type Matrix } from "../../geometry";

const N_SECTORS = 32; // number of sectors, which are drawn or left out
const SECTOR_EDGES = 8; // number of edges of a ring in a sector
const RADII = [0.2, 12, 1500, 2e5]; // of the first ring, up to which short and long waves are shown, and of the last ring [m]
const N_RINGS = [80, 48, 15]; // numbers of rings between these radii
export const COARSE_STEP = 2; // rings and edges of the mesh in one of the mesh for a camera under water
const N_BORDER_POINTS = 12;

/** The part of the surface that a camera may see. */
export interface SurfaceView {
  /** The indices of the sectors. */
  sectors: number[];
  /** The least and the greatest horizontal distance from the camera [m]. */
  minRadius: number;
  maxRadius: number;
}

/** The vertices and triangles of the surface. */
export class SurfaceMesh {
  private readonly vertexArray: WebGLVertexArrayObject;
  private readonly radii: number[];
  private readonly nEdges: number;

  /** `step`: the number of rings and edges that are joined to one, 1 or `COARSE_STEP`. */
  constructor(private readonly gl: WebGL2RenderingContext, step = 1) {
    const radii = (this.radii = ringRadii().filter((_, i) => i % step === 0));
    const nEdges = (this.nEdges = SECTOR_EDGES / step);
    const nAngles = N_SECTORS * nEdges;
    const row = nAngles + 1;
    const vertices = radii.flatMap((radius) =>
      Array.from({ length: row }, (_, i) => (2 * Math.PI * i) / nAngles).flatMap((angle) => [
        radius * Math.cos(angle), radius * Math.sin(angle),
      ]),
    );
    const triangles: number[] = [];
    for (let sector = 0; sector < N_SECTORS; ++sector)
      for (let ring = 0; ring < radii.length - 1; ++ring)
        for (let edge = 0; edge < nEdges; ++edge) {
          const first = row * ring + nEdges * sector + edge;
          const outerVertex = first + row;
          triangles.push(first, outerVertex, outerVertex + 1, first, outerVertex + 1, first + 1);
        }
    this.vertexArray = gl.createVertexArray();
    gl.bindVertexArray(this.vertexArray);
    gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ARRAY_BUFFER, Float32Array.from(vertices), gl.STATIC_DRAW);
    gl.enableVertexAttribArray(ATTRIBUTES.vertex);
    gl.vertexAttribPointer(ATTRIBUTES.vertex, 2, gl.FLOAT, false, 0, 0);
    gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
    gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, Uint32Array.from(triangles), gl.STATIC_DRAW);
    gl.bindVertexArray(null);
  }

  /** Draw the visible part with the current program. */
  draw({ sectors, minRadius, maxRadius }: SurfaceView): void {
    const { gl, radii } = this;
    const ringSize = 6 * this.nEdges;
    const first = Math.max(indexOf(radii, minRadius) - 2, 0);
    const nRings = Math.min(indexOf(radii, maxRadius) + 1, radii.length - 1) - first;
    if (nRings <= 0) return;
    gl.bindVertexArray(this.vertexArray);
    for (const sector of sectors) {
      const index = sector * (radii.length - 1) * ringSize + first * ringSize;
      gl.drawElements(gl.TRIANGLES, nRings * ringSize, gl.UNSIGNED_INT, 4 * index);
    }
    gl.bindVertexArray(null);
  }
}

/** Return the part of the surface that a camera may see, from its height above the still surface and the greatest elevation [m]. */
export function findSurfaceView(m: Matrix, lens: Intrinsics, height: number, maxElevation: number): SurfaceView {
  const rays = borderPoints(lens).map(([u, v]) => {
    const y = -(v - lens.cy) / lens.fy;
    return rotate(m, [(u - lens.cx - lens.skew * y) / lens.fx, y, -1]);
  });
  const isVerticalVisible = seesVertical(m, lens);
  let sectors = isVerticalVisible ? Array.from({ length: N_SECTORS }, (_, i) => i) : sectorsOf(m, rays);
  const side = height > 0 ? -1 : 1;
  const [near, far] = [Math.abs(height) - maxElevation, Math.abs(height) + maxElevation];
  const climbs = rays.map(([x, y, z]) => (side * z) / Math.hypot(x, y));
  const [maxClimb, minClimb] = [1.05 * Math.max(...climbs), 0.95 * Math.min(...climbs)];
  let [minRadius, maxRadius] = [0, RADII[3]];
  if (near > 0) {
    if (!isVerticalVisible && maxClimb <= 0) sectors = [];
    if (!isVerticalVisible) minRadius = near / Math.max(maxClimb, 1e-9);
    const looksTowards = side * m[10] < 0;
    if (minClimb > 0 && (!isVerticalVisible || looksTowards)) maxRadius = Math.min(far / minClimb, RADII[3]);
  }
  return { sectors, minRadius, maxRadius };
}

/** Return points along the border of an image [px]. */
function borderPoints({ width, height }: Intrinsics): [number, number][] {
  return Array.from({ length: N_BORDER_POINTS }, (_, i) => i / (N_BORDER_POINTS - 1)).flatMap((share) => {
    const [u, v] = [width * share - 0.5, height * share - 0.5];
    return [[u, -0.5], [u, height - 0.5], [-0.5, v], [width - 0.5, v]] as [number, number][];
  });
}

/** Return the indices of the sectors between rays along the border of an image. */
function sectorsOf(m: Matrix, rays: number[][]): number[] {
  const middle = Math.atan2(-m[6], -m[2]);
  const angles = rays.map(([x, y]) => {
    const angle = Math.atan2(y, x) - middle;
    return angle - 2 * Math.PI * Math.floor(angle / (2 * Math.PI) + 0.5);
  });
  const step = (2 * Math.PI) / N_SECTORS;
  const first = Math.floor((middle + Math.min(...angles)) / step - 0.25);
  const lastSector = Math.floor((middle + Math.max(...angles)) / step + 0.25);
  const sectors = new Set<number>();
  for (let sector = first; sector <= lastSector; ++sector) sectors.add(((sector % N_SECTORS) + N_SECTORS) % N_SECTORS);
  return [...sectors].sort((a, b) => a - b);
}

/** Return true if the zenith or the nadir is in view, or near its border. */
function seesVertical(m: Matrix, lens: Intrinsics): boolean {
  return [1, -1].some((sign) => {
    const [x, y, z] = [sign * m[8], sign * m[9], sign * m[10]];
    if (z >= -1e-6) return false;
    const u = (lens.fx * x) / -z + (lens.skew * y) / -z + lens.cx;
    const v = (-lens.fy * y) / -z + lens.cy;
    const margin = 0.1 * lens.width;
    return -margin <= u && u <= lens.width + margin && -margin <= v && v <= lens.height + margin;
  });
}

/** Return the index of the first radius that is not below a given one. */
function indexOf(radii: number[], radius: number): number {
  const index = radii.findIndex((candidate) => candidate >= radius);
  return index < 0 ? radii.length : index;
}

function ringRadii(): number[] {
  const ratios = (start: number, end: number, n: number) =>
    Array.from({ length: n }, (_, i) => start * (end / start) ** ((i + 1) / n));
  return [0, RADII[0], ...N_RINGS.flatMap((n, i) => ratios(RADII[i], RADII[i + 1], n))];
}
