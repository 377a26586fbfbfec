autocmd BufRead,BufNewFile *.3dd,*.3ddat,*.fis setlocal filetype=kaya
