// Meshes and textures on the GPU, and the instances of meshes in the scene, which are drawn in pieces.
import type { Head, Visual } from "./head";
import {
  determinant, dot, fromPose, matrix, normalMatrix, product, transform, rotate, unit,
  type Matrix,
} from "./geometry";
import type { Pack } from "./pack";
import { Sand, type Removal } from "./sand";
import { MaterialMaps } from "./drawing/material";
import { loadTexture, upload } from "./drawing/upload";

/** A range of adjacent triangles of an instance, with its bounds in W, as in uwsim.rendering.gpu_model. */
export interface Piece {
  instance: Instance;
  /** The position of the first vertex index in the mesh's list of triangles. */
  firstIndex: number;
  /** The number of vertex indices, three for each triangle. */
  count: number;
  /** The centre of the bounding sphere [m]. */
  centre: [number, number, number];
  /** The radius of the bounding sphere [m]. */
  radius: number;
  /** The corners of the bounding box along the axes of the mesh [m]. */
  corners: [number, number, number][];
  /** The unit normal of a flat piece; 0 if the piece is not flat. */
  normal: [number, number, number];
  /** The greatest number of texels on a length of 1 m [1/m]. */
  density: number;
}

/** A mesh of the scene at the pose of its body. */
export class Instance {
  readonly pieces: Piece[];
  worldFromMesh: Matrix = matrix(new Array(16).fill(0));
  /** The matrix that transforms normals from the mesh to W. */
  normals: Matrix = this.worldFromMesh;
  /** True if the transform mirrors the mesh, so that its triangles are clockwise. */
  isMirrored = false;
  private readonly bodyFromMesh: Matrix;
  /** True if the selected trial has the instance. */
  isPresent = true;

  constructor(
    /** The index of the instance in `Models.instances`. */
    readonly index: number,
    readonly visual: Visual,
    /** The name of the body to which the mesh belongs. */
    readonly body: string,
    readonly vertexArray: WebGLVertexArrayObject | null,
    readonly texture: WebGLTexture | null,
    /** True if the texture is repeated outside of 0 .. 1. */
    readonly repeats: boolean,
    readonly hasUint32Indices: boolean,
    /** The pieces in the frame of the mesh, in the format `pieces` of the head. */
    private readonly pieceRows: number[][],
  ) {
    this.bodyFromMesh = matrix(visual.matrix);
    this.pieces = pieceRows.map(([firstIndex, count]) => ({
      instance: this, firstIndex, count, centre: [0, 0, 0], radius: 0, corners: [], normal: [0, 0, 0],
      density: 0,
    }));
  }

  /** Set the pose of the instance's body; return true if the pose has changed. */
  place(worldFromBody: Matrix): boolean {
    const worldFromMesh = product(worldFromBody, this.bodyFromMesh);
    if (worldFromMesh.every((value, i) => value === this.worldFromMesh[i])) return false;
    this.worldFromMesh = worldFromMesh;
    this.normals = normalMatrix(worldFromMesh);
    this.isMirrored = determinant(worldFromMesh) < 0;
    const [stretch, densityFactor] = [stretchBound(worldFromMesh), stretchBound(this.normals)];
    this.pieceRows.forEach((row, i) => {
      const piece = this.pieces[i];
      piece.centre = transform(worldFromMesh, row.slice(2, 5));
      piece.radius = row[5] * stretch;
      const box = [row.slice(6, 9), row.slice(9, 12)];
      piece.corners = [0, 1, 2, 3, 4, 5, 6, 7].map((k) =>
        transform(worldFromMesh, [box[k >> 2][0], box[(k >> 1) & 1][1], box[k & 1][2]]),
      );
      const normal = row.slice(12, 15);
      piece.normal = dot(normal, normal) > 0 ? unit(rotate(this.normals, normal)) : [0, 0, 0];
      piece.density = row[15] * densityFactor;
    });
    return true;
  }
}

/** Return an upper bound of |A v| / |v| for the 3 x 3 part A of a matrix: the square root of the largest row sum of |A'A|. */
function stretchBound(m: Matrix): number {
  const columns = [0, 1, 2].map((i) => [m[i], m[4 + i], m[8 + i]]);
  const sums = columns.map((a) => columns.reduce((sum, b) => sum + Math.abs(dot(a, b)), 0));
  return Math.sqrt(Math.max(...sums));
}

/** The instances of the meshes of a scene, and the present poses of its bodies. */
export class Models {
  readonly instances: Instance[] = [];
  /** A counter that is incremented whenever a body or the sand has moved. */
  version = 0;
  /** The projector's pattern; empty if there is no projector. */
  readonly patterns: WebGLTexture[] = [];
  /** The maps of the materials; null without WebGL. */
  maps: MaterialMaps | null = null;
  private readonly bodies = new Map<string, Matrix>(); // world from body, by the body's name
  private readonly radii = new Map<number, number>(); // half the longest side of a model [m], by its index in the scene
  private readonly sand: { heap: Sand; positions: WebGLBuffer; normals: WebGLBuffer }[] = [];

  private constructor(
    private readonly head: Head,
    private readonly gl: WebGL2RenderingContext | null,
  ) {}

  /** Load the meshes and textures of a pack; without WebGL, only the poses of the bodies. */
  static async load(gl: WebGL2RenderingContext | null, pack: Pack): Promise<Models> {
    const models = new Models(pack.head, gl);
    models.place(new Map());
    if (!gl) return models;
    const { meshes, textures, projector } = pack.head;
    const images = await Promise.all(
      textures.map(({ repeats }, i) => loadTexture(gl, pack, i, i !== projector?.pattern && repeats)),
    );
    if (projector) models.patterns.push(images[projector.pattern]);
    models.maps = new MaterialMaps(gl, pack, images, textures);
    const gpuMeshes = meshes.map((_, i) => upload(gl, pack, i));
    const vertexArrays = gpuMeshes.map(({ vertexArray }) => vertexArray);
    for (const heap of pack.head.sand ?? []) {
      const positions = pack.numbers(meshes[heap.mesh].positions) as Float32Array;
      models.sand.push({ heap: new Sand(heap, positions), ...gpuMeshes[heap.mesh] });
    }
    for (const [body, visual] of allVisuals(pack.head)) {
      const { texture, mesh } = visual;
      const image = texture === null ? null : images[texture];
      const repeats = texture !== null && textures[texture].repeats;
      const hasUint32Indices = meshes[mesh].triangles[2] === "u4";
      const [n, pieces] = [models.instances.length, meshes[mesh].pieces];
      models.instances.push(
        new Instance(n, visual, body, vertexArrays[mesh], image, repeats, hasUint32Indices, pieces),
      );
    }
    models.select(0);
    models.place(new Map());
    return models;
  }

  /** Show the meshes of a trial. */
  select(trial: number): void {
    const keys = new Set(this.head.bodies.flatMap(({ name }) =>
      visualsOf(this.head, trial, name).map((visual) => keyOf(name, visual))));
    for (const instance of this.instances) instance.isPresent = keys.has(keyOf(instance.body, instance.visual));
    this.version += 1;
    this.computeRadii();
  }

  /** Set the poses of all bodies (world from body); a body that is not in `poses` has its initial pose. */
  place(poses: Map<string, Matrix>): void {
    for (const body of this.head.bodies)
      this.bodies.set(body.name, poses.get(body.name) ?? fromPose(body.pose));
    let hasMoved = false;
    for (const instance of this.instances) hasMoved = instance.place(this.body(instance.body)) || hasMoved;
    if (!hasMoved) return;
    this.version += 1;
    this.computeRadii();
  }

  /** Set the sand of the heap with an index, from the removals so far, or from the heights of its columns [m]. */
  setSand(index: number, sand: Removal[] | Float32Array): void {
    const { gl } = this;
    const { heap, positions, normals } = this.sand[index] ?? {};
    if (!gl || !heap || !positions || !normals) return;
    if (!(sand instanceof Float32Array ? heap.set(sand) : heap.apply(sand))) return;
    const surface = heap.surface();
    gl.bindBuffer(gl.ARRAY_BUFFER, positions);
    gl.bufferData(gl.ARRAY_BUFFER, surface.positions, gl.STATIC_DRAW);
    gl.bindBuffer(gl.ARRAY_BUFFER, normals);
    gl.bufferData(gl.ARRAY_BUFFER, surface.normals, gl.STATIC_DRAW);
    this.version += 1;
  }

  /** Return the heights of the columns of heap `index` above the corner of the heap [m]. */
  heights(index: number): Float32Array {
    return this.sand[index]?.heap.heights ?? new Float32Array();
  }

  /** Return the present pose of a body in W; the identity if there is no such body. */
  body(name: string): Matrix {
    return this.bodies.get(name) ?? fromPose([0, 0, 0, 1, 0, 0, 0]);
  }

  /** Return the pose in W of a part that is mounted on a body; if `body` is null, its pose is given in W. */
  worldFromMount(mount: { body: string | null; pose: number[] }): Matrix {
    const bodyFromMount = fromPose(mount.pose);
    return mount.body === null ? bodyFromMount : product(this.body(mount.body), bodyFromMount);
  }

  /** Return half the longest side of the box around the bounding spheres of a model's pieces [m]. */
  radius(instance: Instance): number {
    return this.radii.get(instance.visual.part) ?? 0;
  }

  /** Compute the radii of all models. */
  private computeRadii(): void {
    const boxes = new Map<number, number[]>();
    for (const { visual, pieces, isPresent } of this.instances) {
      if (!isPresent) continue;
      const box = boxes.get(visual.part) ?? [Infinity, Infinity, Infinity, -Infinity, -Infinity, -Infinity];
      for (const { centre, radius } of pieces)
        for (let i = 0; i < 3; ++i) {
          box[i] = Math.min(box[i], centre[i] - radius);
          box[3 + i] = Math.max(box[3 + i], centre[i] + radius);
        }
      boxes.set(visual.part, box);
    }
    for (const [part, b] of boxes)
      this.radii.set(part, Math.max(b[3] - b[0], b[4] - b[1], b[5] - b[2]) / 2);
  }
}

/** Return the meshes of a body in a trial. */
export function visualsOf(head: Head, trial: number, body: string): Visual[] {
  const trialVisuals = head.trials?.[trial]?.visuals?.[body];
  return trialVisuals ?? head.bodies.find(({ name }) => name === body)?.visuals ?? [];
}

/** Return a text that is the same for equal meshes of a body. */
function keyOf(body: string, visual: Visual): string {
  return `${body} ${JSON.stringify(visual)}`;
}

/** Return the meshes of all bodies in all trials, each once, with the names of their bodies. */
function allVisuals(head: Head): [string, Visual][] {
  const entries = head.bodies.flatMap(({ name, visuals }) => visuals.map((visual): [string, Visual] => [name, visual]));
  const keys = new Set(entries.map(([body, visual]) => keyOf(body, visual)));
  for (const { visuals = {} } of head.trials ?? [])
    for (const [body, trialVisuals] of Object.entries(visuals))
      for (const visual of trialVisuals) {
        const key = keyOf(body, visual);
        if (!keys.has(key)) entries.push([body, visual]);
        keys.add(key);
      }
  return entries;
}
