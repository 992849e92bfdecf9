// Files that Vite puts into the page, as addresses.
declare module '*?url' {
  const address: string;
  export default address;
}
