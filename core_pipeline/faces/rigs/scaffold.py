"""Parts that a rig carries for its tools and nobody is to see: the proxies of MakeHuman, the handles of Rigify."""

from __future__ import annotations

import re

#: MakeHuman's base mesh is wrapped in tights, a skirt and hair that clothes are fitted to, and marks its joints with
#: cubes; its helpers for eyes, teeth, tongue and lashes are what an undressed one shows. Rigify's handles are "WGT-…".
_SCAFFOLD = re.compile(r"(?<![^\W_])(helper[-_ ](tights|skirt|hair|genital)|joint-[a-z]|wgt[-_])", re.IGNORECASE)

#: What is told of a rig that has such parts.
LEFT_OUT = "Parts that only its tools need (helpers, joints, handles) are left out."


def is_scaffold(name: str) -> bool:
    """Whether a part of this name is one of the tools' own, not of the face."""
    return _SCAFFOLD.search(name) is not None
