// An Anchor of the world leads out of the page: the user is asked, and follows the link or not.
import {button, h} from './dom';

/// Only what a page may lead to: files of this computer (with a host they would be of another one), and the web.
function address(url: string): string | null {
  try {
    const to = new URL(url, location.href);
    const allowed = ['http:', 'https:'].includes(to.protocol) || (to.protocol === 'file:' && to.host === '');
    return allowed ? to.href : null;
  } catch {
    return null;
  }
}

export function askToOpen(url: string): void {
  if (document.querySelector('dialog[open]')) return;
  const to = address(url);
  const dialog: HTMLDialogElement = h('dialog', {class: 'help open', 'aria-labelledby': 'open-title'},
    h('h2', {id: 'open-title'}, 'Leave this page?'),
    h('p', {}, 'The world has a link to ', h('code', {}, to ?? url), to ? '.' : ', which cannot be opened from here.'),
    h('div', {class: 'buttons'}, ...(to ? [h('a', {href: to, target: '_blank', rel: 'noopener noreferrer', class: 'button', click: () => dialog.remove()}, 'Open it')] : []),
      button('Stay here', () => dialog.remove())));
  document.body.append(dialog);
  dialog.showModal();
}
