"""The studio: a page on which a drum turns while it is changed.

`session` runs a simulation in a thread, `scene` and `measures` say what is shown of it, `controls` what can be changed,
`server` brings both to a browser; the page is studio.js of `viewer`, made of the parts that the player is made of.
"""

from drumrs.studio.session import Session

__all__ = ["Session"]
