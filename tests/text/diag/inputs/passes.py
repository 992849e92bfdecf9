"""Passes that tests run."""
from typing import Literal

import wrlkit


@wrlkit.pass_
def ends_badly(world):
    """Fail."""
    raise LookupError('there is no table')


@wrlkit.pass_
def says(world, severity: Literal['error', 'warning', 'lost'] = 'warning'):
    """Say something of the first Box."""
    world.report(severity, 'a Box is no pump', world.nodes('Box')[0])
