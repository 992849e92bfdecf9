"""Lists that fields are read as."""


class FixedList(list):
    """What a field holds, as a list that cannot be changed: a change would be one of a copy, which the world never sees."""
    __slots__ = ('_owner',)

    def __init__(self, values, owner):
        super().__init__(values)
        self._owner = owner

    def _refuse(self, *_, **__):
        raise TypeError(f'{self._owner} is read as a copy, which cannot be changed; write it as a whole ([*old, new]), or change list(...) of it')

    append = extend = insert = remove = pop = clear = sort = reverse = __setitem__ = __delitem__ = _refuse

    def __iadd__(self, more):
        return [*self, *more]    # node.children += [other] writes it

    def __imul__(self, n):
        return list(self) * n

    def __reduce_ex__(self, protocol):
        return list, (list(self),)
