// Files that Vite puts into the page, as addresses.
declare module '*?url' {
  const address: string;
  export default address;
}

// Files whose text Vite puts into the page.
declare module '*?raw' {
  const text: string;
  export default text;
}
