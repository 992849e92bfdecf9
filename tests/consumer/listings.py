"""The listings of a page that have a name, ```cpp NAME, as files of a folder:  listings.py PAGE.md FOLDER"""
import pathlib, re, sys

page, folder = map(pathlib.Path, sys.argv[1:])
folder.mkdir(parents=True)
listings = re.findall(r'^```cpp (\S+)\n(.*?)^```$', page.read_text(), re.M | re.S)
for name, text in listings:
    (folder / name).write_text(text)
sys.exit(not listings and f'{page} has no listing')
