"""The studio's page: one file of HTML, with the viewer's modules in it."""

import secrets

from drumrs.viewer import module

_PAGE = """<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>drumrs studio</title>
<link rel="icon" href="data:,">
<style>
body {{ max-width: 1240px; margin: 0 auto; padding: 12px; background: Canvas; }}
@media (max-width: 500px) {{ body {{ padding: 0; }} }}
</style>
</head>
<body>
<main></main>
<script type="module" nonce="{nonce}">
{module}</script>
</body>
</html>
"""


def page() -> tuple[str, str]:
    """Return the page and the content security policy to send along: nothing is loaded, and only we are asked."""
    nonce = secrets.token_urlsafe(16)
    policy = (
        f"default-src 'none'; script-src 'nonce-{nonce}'; style-src 'unsafe-inline'; connect-src 'self'; "
        "img-src data: blob:; media-src blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'"
    )
    return _PAGE.format(nonce=nonce, module=module("studio_page.js")), policy
