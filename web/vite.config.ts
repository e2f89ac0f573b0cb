import { svelte } from "@sveltejs/vite-plugin-svelte";
import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { defineConfig, type Plugin } from "vite";

const bundle = "../python/freebody/views/report/bundle";

/** The digest of all that the bundle is made of, which tests/views/test_bundle.py compares. */
function digest(): string {
  const hash = createHash("sha256");
  const sources = readdirSync("src", { recursive: true, withFileTypes: true })
    .filter((entry) => entry.isFile())
    .map((entry) => `${entry.parentPath}/${entry.name}`);
  for (const path of [...sources, "package-lock.json", "vite.config.ts"].sort()) {
    hash.update(`${path}\0`).update(readFileSync(path)).update("\0");
  }
  return hash.digest("hex");
}

/** Marks the bundle with the digest, and leaves no address in it: the runtime's hints link to a site. */
const stamped: Plugin = {
  name: "stamped",
  generateBundle(_, files) {
    for (const file of Object.values(files)) {
      if (file.type === "chunk") file.code = `/* sources ${digest()} */\n${file.code.replaceAll("https://svelte.dev/e/", "svelte: ")}`;
    }
  },
};

export default defineConfig({
  plugins: [svelte({ compilerOptions: { fragments: "tree" } }), stamped],
  build: {
    outDir: bundle,
    emptyOutDir: true,
    lib: { entry: "src/main.ts", formats: ["iife"], name: "freebody", fileName: () => "report.js", cssFileName: "report" },
  },
});
