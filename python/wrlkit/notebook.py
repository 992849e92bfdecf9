"""What notebooks show of worlds."""
import collections
import html

MOST = 8  # rows of each kind


def world_html(world):
    """A world: what nodes it has most of, and what was wrong with it."""
    kinds = collections.Counter(node.type for node in world.nodes()).most_common()
    rows = [(kind, str(n)) for kind, n in kinds[:MOST]]
    if len(kinds) > MOST:
        rows.append((f'{len(kinds) - MOST} other types', str(sum(n for _, n in kinds[MOST:]))))
    messages = world.messages
    rows += [(message.severity, str(message)) for message in messages[:MOST]]
    if len(messages) > MOST:
        rows.append(('', f'{len(messages) - MOST} more messages'))
    cells = ''.join(f'<tr><th style="text-align:left">{html.escape(name)}</th><td style="text-align:left">{html.escape(text)}</td></tr>' for name, text in rows)
    return f'<table><caption>{html.escape(repr(world)[1:-1])}</caption>{cells}</table>'
