// The button that turns a report light or dark; without a choice the browser's setting decides.
{
  const root = document.documentElement;
  const button = document.getElementById('theme');
  const dark = () => {
    if (root.dataset.theme) return root.dataset.theme === 'dark';
    return matchMedia('(prefers-color-scheme: dark)').matches;
  };
  const label = () => {
    button.textContent = dark() ? 'Light' : 'Dark';
  };
  button.onclick = () => {
    root.dataset.theme = dark() ? 'light' : 'dark';
    label();
  };
  label();
}
