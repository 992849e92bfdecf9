// One HTML file: script and style are in it, so that it opens from disk and can be mailed. `--mode tiles` makes the page of a tileset.
import {fileURLToPath} from 'node:url';
import {defineConfig, type Plugin} from 'vite';

function inline(name: string): Plugin {
  return {
    name: 'inline',
    enforce: 'post',
    generateBundle(_, bundle) {
      const page = bundle[name];
      if (page?.type !== 'asset') throw new Error('no page');
      let html = String(page.source);
      for (const [part, file] of Object.entries(bundle)) {
        if (file === page) continue;
        const text = file.type === 'chunk' ? file.code.replaceAll('</script', '<\\/script') : String(file.source);
        const tag = file.type === 'chunk' ? new RegExp(`<script[^>]*src="[^"]*${part}"[^>]*></script>`) : new RegExp(`<link[^>]*href="[^"]*${part}"[^>]*>`);
        const element = file.type === 'chunk' ? `<script type="module">${text}</script>` : `<style>${text}</style>`;
        if (!tag.test(html)) throw new Error(`${part} is not in the page`);
        html = html.replace(tag, () => element);
        delete bundle[part];
      }
      page.source = html;
    },
  };
}

/// DRACOLoader brings three decoders along; the page has one (src/tiles/loading.ts).
const oneDecoder: Plugin = {
  name: 'one-decoder',
  enforce: 'pre',
  transform: (code, id) => id.endsWith('/DRACOLoader.js') ? code.replaceAll(/new URL\( '[^']*', import\.meta\.url \)/g, "''") : null,
};

// The built files of this package bring along all of its plugins.
const sources = '3d-tiles-renderer/src';
const alias = [
  {find: 'wrlkit-three', replacement: fileURLToPath(new URL('../integrations/three/src/index.ts', import.meta.url))},
  {find: /^3d-tiles-renderer\/core$/, replacement: `${sources}/core/renderer/index.js`},
  {find: /^3d-tiles-renderer\/three$/, replacement: `${sources}/three/renderer/index.js`},
  {find: /^3d-tiles-renderer\/three\/plugins$/, replacement: `${sources}/three/plugins/GLTFExtensionsPlugin.js`},
];

export default defineConfig(({mode}) => {
  const page = mode === 'tiles' ? 'tiles.html' : 'index.html';
  return {
    base: './',
    plugins: [oneDecoder, inline(page)],
    resolve: {alias, dedupe: ['three']},
    build: {target: 'es2022', modulePreload: false, cssCodeSplit: false, assetsInlineLimit: 1e8, emptyOutDir: false, chunkSizeWarningLimit: 2000, rollupOptions: {input: page}},
  };
});
