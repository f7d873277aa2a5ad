// Meshes and textures of a pack, uploaded to the GPU.
import type { Ref } from "../head";
import type { Pack } from "../pack";
import { addMaterialAttributes } from "./material";
import { ATTRIBUTES } from "./shaders";

/** The buffers of a mesh on the GPU. */
export interface GpuMesh {
  vertexArray: WebGLVertexArrayObject;
  positions: WebGLBuffer;
  normals: WebGLBuffer;
}

/** Upload the mesh with an index to the GPU. */
export function upload(gl: WebGL2RenderingContext, pack: Pack, index: number): GpuMesh {
  const mesh = pack.head.meshes[index];
  const vertexArray = gl.createVertexArray();
  gl.bindVertexArray(vertexArray);
  const attribute = (name: string, size: number, kind: number, data: ArrayBufferView<ArrayBuffer>): WebGLBuffer => {
    const buffer = gl.createBuffer();
    gl.bindBuffer(gl.ARRAY_BUFFER, buffer);
    gl.bufferData(gl.ARRAY_BUFFER, data, gl.STATIC_DRAW);
    gl.enableVertexAttribArray(ATTRIBUTES[name]);
    gl.vertexAttribPointer(ATTRIBUTES[name], size, kind, kind !== gl.FLOAT, 0, 0);
    return buffer;
  };
  const numbers = (ref: typeof mesh.positions) => pack.numbers(ref) as ArrayBufferView<ArrayBuffer>;
  const positions = attribute("vertex", 3, gl.FLOAT, numbers(mesh.positions));
  const normals = attribute("vertex_normal", 3, gl.SHORT, numbers(mesh.normals));
  attribute("tint", 3, gl.UNSIGNED_SHORT, numbers(mesh.tints));
  if (mesh.uvs) attribute("uv", 2, gl.FLOAT, numbers(mesh.uvs));
  addMaterialAttributes(mesh, (name, n, type, ref) => attribute(name, n, gl[type], numbers(ref)));
  gl.bindBuffer(gl.ELEMENT_ARRAY_BUFFER, gl.createBuffer());
  gl.bufferData(gl.ELEMENT_ARRAY_BUFFER, numbers(mesh.triangles), gl.STATIC_DRAW);
  gl.bindVertexArray(null);
  return { vertexArray, positions, normals };
}

/** Load the texture of a pack with an index to the GPU. */
export async function loadTexture(
  gl: WebGL2RenderingContext, pack: Pack, index: number, repeats: boolean,
): Promise<WebGLTexture> {
  const { type, bytes, levels } = pack.head.textures[index];
  const isPattern = index === pack.head.projector?.pattern;
  const decode = (data: Ref, type: string) =>
    createImageBitmap(new Blob([pack.numbers(data) as Uint8Array<ArrayBuffer>], { type }), {
      imageOrientation: isPattern ? "from-image" : "flipY", // OpenGL's first row is v = 0
      premultiplyAlpha: "none",
      colorSpaceConversion: "none",
    });
  const image = await decode(bytes, type);
  const mipmaps = await Promise.all((levels ?? []).map((level) => decode(level, "image/webp")));
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D, texture);
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, image);
  const wrap = repeats ? gl.REPEAT : gl.CLAMP_TO_EDGE;
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_S, wrap);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_WRAP_T, wrap);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MIN_FILTER, isPattern ? gl.LINEAR : gl.LINEAR_MIPMAP_LINEAR);
  if (levels) gl.texParameteri(gl.TEXTURE_2D, gl.TEXTURE_MAX_LEVEL, levels.length);
  else if (!isPattern) gl.generateMipmap(gl.TEXTURE_2D);
  mipmaps.forEach((level, i) => gl.texImage2D(gl.TEXTURE_2D, i + 1, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, level));
  image.close();
  return texture;
}

