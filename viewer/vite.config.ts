// One HTML file: script and style stand in it, so that it opens from disk and can be mailed.
import {fileURLToPath} from 'node:url';
import {defineConfig, type Plugin} from 'vite';

function inline(): Plugin {
  return {
    name: 'inline',
    enforce: 'post',
    generateBundle(_, bundle) {
      const page = bundle['index.html'];
      if (page?.type !== 'asset') throw new Error('no page');
      let html = String(page.source);
      for (const [name, file] of Object.entries(bundle)) {
        if (file === page) continue;
        const text = file.type === 'chunk' ? file.code.replaceAll('</script', '<\\/script') : String(file.source);
        const tag = file.type === 'chunk' ? new RegExp(`<script[^>]*src="[^"]*${name}"[^>]*></script>`) : new RegExp(`<link[^>]*href="[^"]*${name}"[^>]*>`);
        const element = file.type === 'chunk' ? `<script type="module">${text}</script>` : `<style>${text}</style>`;
        if (!tag.test(html)) throw new Error(`${name} is not in the page`);
        html = html.replace(tag, () => element);
        delete bundle[name];
      }
      page.source = html;
    },
  };
}

export default defineConfig({
  base: './',
  plugins: [inline()],
  resolve: {alias: {'wrlkit-three': fileURLToPath(new URL('../integrations/three/src/index.ts', import.meta.url))}, dedupe: ['three']},
  build: {target: 'es2022', modulePreload: false, cssCodeSplit: false, assetsInlineLimit: 1e8, emptyOutDir: true, chunkSizeWarningLimit: 2000},
});
